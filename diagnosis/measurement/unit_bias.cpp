#include "diagnosis/measurement/unit_bias.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <tuple>

namespace fathom {
namespace {

/// A view of a desk has a bias of its own of 0.04 px that is smooth over 8 px (docs/calibrate.md). Independent errors
/// of cells of 16 px as large as this one move wide shapes as much.
constexpr double kOfView_px = 0.05;

double covariance(const BiasPrior& prior, double distance_px) {
  double sum = 0.0;
  for (std::size_t i = 0; i < kBiasReaches_px.size(); ++i) {
    const double over = distance_px / kBiasReaches_px[i];
    sum += (prior.reference_px[i] * prior.reference_px[i] + prior.camera_px[i] * prior.camera_px[i]) *
           std::exp(-0.5 * over * over);
  }
  return sum;
}

/// The planes that fit biases of this prior best, as three independent ones of 1 σ.
std::vector<Bias> planes_of(const BiasPrior& prior) {
  constexpr double kApart_px = 32.0;
  std::vector<Eigen::Vector2d> pixels;
  for (double y = 0.5 * kApart_px; y < kImageHeight_px; y += kApart_px)
    for (double x = 0.5 * kApart_px; x < kImageWidth_px; x += kApart_px) pixels.emplace_back(x, y);
  const auto n = static_cast<Eigen::Index>(pixels.size());
  Eigen::MatrixXd basis(n, 3), process(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    basis.row(i) = plane_at(pixels[i]);
    for (Eigen::Index j = 0; j < n; ++j) process(i, j) = covariance(prior, (pixels[i] - pixels[j]).norm());
  }
  const Eigen::MatrixXd fit = (basis.transpose() * basis).ldlt().solve(basis.transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(Eigen::Matrix3d(fit * process * fit.transpose()));
  std::vector<Bias> planes;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d plane = std::sqrt(std::max(eigen.eigenvalues()[i], 0.0)) * eigen.eigenvectors().col(i);
    planes.emplace_back([plane](const BiasPoint& point) { return plane.dot(plane_at(point.pixel_px)); });
  }
  return planes;
}

}  // namespace

Bias as_bias(const BiasField& field) {
  return [&field](const BiasPoint& point) { return field.at(point); };
}

Bias as_bias(const UnitMap& map) {
  return [&map](const BiasPoint& point) -> double {
    const Eigen::Vector2d& pixel = point.pixel_px;
    const auto within = [](double at, double size) { return static_cast<int>(std::clamp(at, 0.0, size - 1.0)); };
    return map.reference_of(pixel.x() - point.nearer_px, pixel.y()) +
           map.camera_of(within(pixel.x(), kImageWidth_px), within(pixel.y(), kImageHeight_px));
  };
}

UnitBias::Views UnitBias::views_of(const Desks& desks, bool is_calibrated) {
  Views all;
  all.prior = default_bias_prior();
  if (is_calibrated)
    for (double& amplitude : all.prior.reference_px) amplitude *= kLeftByCalibration;
  std::map<int, DeskCells> together;
  DeskCells whole;
  std::map<std::tuple<int, double, double>, double> scenes;  // of a session that show a cell
  std::vector<double> placements;                            // that show a view
  ViewScatter scatter;
  for (const auto& [scene, cells] : desks) {
    DeskCells sum;
    std::vector<BiasView> views;
    for (const DeskCells& placement : cells) {
      if (BiasView view = placement.view(); !view.cells.empty()) views.push_back(std::move(view));
      sum.add(placement);
    }
    if (views.empty()) continue;
    scatter.add(views);
    placements.push_back(static_cast<double>(views.size()));
    together[scene.session].add(sum);
    whole.add(sum);
    all.sessions.push_back(scene.session);
    all.views.push_back(sum.view());
    for (const BiasCell& cell : all.views.back().cells) ++scenes[{scene.session, cell.column_px, cell.row_px}];
  }
  if (all.views.empty()) return all;
  double of_dots_px = 0.0;  // error of a cell that is the same in all scenes of a session
  for (const auto& [session, cells] : together)
    of_dots_px = std::max(of_dots_px, own_error_px(all.of_sessions[session] = cells.view()));
  all.prior = bias_prior_of(whole.view(), all.prior);
  all.prior.cell_px = of_dots_px;
  const double of_dots = of_dots_px * of_dots_px, of_placement = std::pow(scatter.cell_px().value_or(kOfView_px), 2);
  all.weight_of_one = of_dots / (of_dots + of_placement);
  for (std::size_t i = 0; i < all.views.size(); ++i)
    for (BiasCell& cell : all.views[i].cells) {
      const double shared_by = scenes.at({all.sessions[i], cell.column_px, cell.row_px});
      cell.pixels *= of_dots / (of_dots * shared_by + of_placement / placements[i]);
    }
  return all;
}

UnitBias::UnitBias(const Desks& desks, bool is_calibrated) : UnitBias(views_of(desks, is_calibrated)) {}

UnitBias::UnitBias(Views views)
    : views_(std::move(views)), learner_(views_.views, views_.prior), field_(learner_.learn()) {}

std::vector<DeskDifference> UnitBias::session_differences() const { return desk_differences(views_.of_sessions); }

UnitBias UnitBias::with_bare_desks() const {
  Views all;
  all.of_sessions = views_.of_sessions;
  all.prior = views_.prior;
  all.weight_of_one = views_.weight_of_one;
  for (const auto& [session, seen] : views_.of_sessions) {
    // A desk's disparity is linear over the image.
    const Eigen::Vector3d nearer = plane_through(seen.cells, nearer_px(seen.cells));
    all.sessions.push_back(session);
    BiasView& view = all.views.emplace_back();
    for (double row = 0.5 * kBiasCell_px; row < kImageHeight_px; row += kBiasCell_px)
      for (double column = 0.5 * kBiasCell_px; column < kImageWidth_px; column += kBiasCell_px) {
        view.cells.push_back(
            {column, row, nearer.dot(plane_at({column, row})), all.weight_of_one * kBiasCell_px * kBiasCell_px});
        view.errors_px.push_back(0.0);
      }
  }
  return UnitBias(std::move(all));
}

BiasField UnitBias::learn(const std::map<int, DeskError>& desks) const {
  std::vector<Eigen::VectorXd> errors;
  for (std::size_t i = 0; i < views_.views.size(); ++i) {
    const BiasView& view = views_.views[i];
    Eigen::VectorXd own = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(view.cells.size()));
    const auto known = desks.find(views_.sessions[i]);
    if (const auto desk = known != desks.end() ? known : desks.begin(); desk != desks.end())
      for (std::size_t cell = 0; cell < view.cells.size(); ++cell)
        own[static_cast<Eigen::Index>(cell)] = desk->second(view.cells[cell]).value_or(0.0);
    errors.push_back(std::move(own));
  }
  return learner_.learn(errors);
}

std::vector<Bias> UnitBias::error_modes(int count, std::span<const BiasPoint> where) const {
  std::vector<Bias> modes = planes_of(default_bias_prior());  // which no calibration by desks can know
  for (BiasField& field : learner_.error_modes(count, where))
    modes.emplace_back([field = std::move(field)](const BiasPoint& point) { return field.at(point); });
  return modes;
}

BiasPoint bias_point(const Eigen::Vector3f& point, const DeviceScale& scale) {
  const double of_inverse = scale.focal_px * scale.baseline_m;
  return {.pixel_px = scale.pixel_px(point), .nearer_px = of_inverse / point.z() - of_inverse / kReferenceDistance_m};
}

BiasPoint bias_point(const Eigen::Vector3f& point, const LaboratoryRig& rig) {
  return bias_point(point, DeviceScale{.focal_px = rig.focal_px, .baseline_m = rig.baseline_m});
}

float stretch_without(const Bias& bias, const BiasPoint& point, double of_inverse, double z) {
  const double disparity_px = of_inverse / z - bias(point);
  return disparity_px > 0.0 ? static_cast<float>(of_inverse / disparity_px / z) : 1.0f;
}

void take_off(const Bias& bias, const LaboratoryRig& rig, std::span<SensedPoint> points) {
  const double of_inverse = rig.focal_px * rig.baseline_m;
  for (SensedPoint& sensed : points) {
    const float z = sensed.point.z();
    if (sensed.device_z == 0.0f) sensed.device_z = z;
    sensed.point *= stretch_without(bias, bias_point(sensed.point, rig), of_inverse, z);
  }
}

}  // namespace fathom
