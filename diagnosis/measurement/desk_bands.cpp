#include "diagnosis/measurement/desk_bands.h"

#include <Eigen/LU>
#include <cmath>

#include "core/units.h"

namespace fathom {
namespace {

constexpr double kWholeBand = 25600.0;  // pixels of a whole band of rows
constexpr double kFewestOfBand = 1000.0;
constexpr double kOfPlane = 2.0;  // of a plane's three parameters, each kind of bands feels so many

struct Pooled {
  double sum_px2 = 0.0;  ///< of the bands' variances between trials, each times its pixels
  double seen = 0.0;     ///< bands that are whole enough in all trials
};

template <class Bands>
Pooled pooled(std::span<const DeskBands> trials, Bands DeskBands::*bands) {
  const auto n = static_cast<double>(trials.size());
  Pooled pooled;
  for (std::size_t i = 0; i < std::tuple_size_v<Bands>; ++i) {
    double weight = 0.0, mean = 0.0, squares = 0.0;
    bool in_all = true;
    for (const DeskBands& trial : trials) {
      const RegionEstimate& band = (trial.*bands)[i];
      in_all = in_all && band.weight >= kFewestOfBand;
      weight += band.weight / n;
      mean += band.mean / n;
    }
    if (!in_all) continue;
    for (const DeskBands& trial : trials) squares += std::pow((trial.*bands)[i].mean - mean, 2);
    pooled.sum_px2 += weight * squares / (n - 1.0);
    pooled.seen += 1.0;
  }
  return pooled;
}

/// Mean over bands of the variance between trials [px²], times the pixels of a band and over kWholeBand.
template <class Bands>
std::optional<double> variance_of(std::span<const DeskBands> trials, Bands DeskBands::*bands) {
  const Pooled all = pooled(trials, bands);
  if (all.seen <= 2.0 * kOfPlane) return std::nullopt;
  return all.sum_px2 / (all.seen - kOfPlane) / kWholeBand;
}

}  // namespace

std::optional<BandScatter> scatter_of(std::span<const DeskBands> trials) {
  if (trials.size() < 2) return std::nullopt;
  const auto rows = variance_of(trials, &DeskBands::rows), columns = variance_of(trials, &DeskBands::columns);
  if (!rows || !columns) return std::nullopt;
  return BandScatter{std::sqrt(*rows), std::sqrt(*columns)};
}

std::optional<PlaneNoise> plane_noise_of(std::span<const DeskBands> trials, const LaboratoryRig& rig) {
  if (trials.size() < 2) return std::nullopt;
  constexpr double kFewestThirds = 5.0, kOfDesk = 3.0;  // the plane takes as many
  const auto n = static_cast<double>(trials.size());
  const Pooled thirds = pooled(trials, &DeskBands::thirds);
  if (thirds.seen < kFewestThirds) return std::nullopt;
  const double of_pixel_px2 = thirds.sum_px2 / (thirds.seen - kOfDesk);  // as if each pixel had an error of its own
  Eigen::Matrix3d sights = Eigen::Matrix3d::Zero();
  for (const DeskBands& trial : trials) sights += trial.sights / n;
  // 1/z = q · s: errors of q, and of what follows from it by derivatives.
  const double per_px = 1.0 / (rig.focal_px * rig.baseline_m);
  const Eigen::Matrix3d of_q = of_pixel_px2 * per_px * per_px * sights.inverse();
  const Plane& desk = trials.front().desk;
  const Eigen::Vector3d q = -desk.normal / desk.offset;
  const auto error = [&](const auto& value) {
    Eigen::Vector3d gradient;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d step = 1e-5 * q.norm() * Eigen::Vector3d::Unit(axis);
      gradient[axis] = (value(q + step) - value(q - step)) / (2.0 * step.norm());
    }
    return std::sqrt(gradient.dot(of_q * gradient));
  };
  return PlaneNoise{error([](const Eigen::Vector3d& p) { return mm_from_metres(1.0 / p.norm()); }),
                    error([](const Eigen::Vector3d& p) { return deg_from_radians(std::asin(p.z() / p.norm())); }),
                    error([](const Eigen::Vector3d& p) { return deg_from_radians(std::atan2(p.x(), p.y())); })};
}

std::vector<NamedValue> scatter_values(std::span<const DeskBands> trials, const LaboratoryRig& rig) {
  const auto bands = scatter_of(trials);
  const auto plane = plane_noise_of(trials, rig);
  if (!bands || !plane) return {};
  constexpr std::string_view kDesk = "desk";
  return {{"desk_rows_px", kDesk, bands->rows_px},
          {"desk_columns_px", kDesk, bands->columns_px},
          {"desk_height_noise_mm", kDesk, plane->height_mm},
          {"desk_pitch_noise_deg", kDesk, plane->pitch_deg},
          {"desk_roll_noise_deg", kDesk, plane->roll_deg}};
}

}  // namespace fathom
