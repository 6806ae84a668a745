#include "diagnosis/measurement/desk_bands.h"

#include <Eigen/LU>
#include <cmath>

#include "core/units.h"

namespace fathom {
namespace {

constexpr double kReference = 25600.0;  // pixels of a whole band of rows
constexpr double kFewestPixels = 1000.0;
constexpr double kOfPlane = 2.0;  // of a plane's three parameters, each kind of bands feels so many

/// Mean over bands of the variance between trials [px²], times the pixels of a band and over kReference.
template <class Bands>
std::optional<double> variance_of(std::span<const DeskBands> trials, Bands DeskBands::*bands) {
  const auto n = static_cast<double>(trials.size());
  double sum = 0.0, seen = 0.0;
  for (std::size_t i = 0; i < std::tuple_size_v<Bands>; ++i) {
    double weight = 0.0, mean = 0.0, squares = 0.0;
    bool in_all = true;
    for (const DeskBands& trial : trials) {
      const RegionEstimate& band = (trial.*bands)[i];
      in_all = in_all && band.weight >= kFewestPixels;
      weight += band.weight / n;
      mean += band.mean / n;
    }
    if (!in_all) continue;
    for (const DeskBands& trial : trials) squares += std::pow((trial.*bands)[i].mean - mean, 2);
    sum += weight * squares / (n - 1.0);
    seen += 1.0;
  }
  if (seen <= 2.0 * kOfPlane) return std::nullopt;
  return sum / (seen - kOfPlane) / kReference;
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
  double sum = 0.0, seen = 0.0;
  Eigen::Matrix3d sights = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < trials.front().thirds.size(); ++i) {
    double weight = 0.0, mean = 0.0, squares = 0.0;
    bool in_all = true;
    for (const DeskBands& trial : trials) {
      in_all = in_all && trial.thirds[i].weight >= kFewestPixels;
      weight += trial.thirds[i].weight / n;
      mean += trial.thirds[i].mean / n;
    }
    if (!in_all) continue;
    for (const DeskBands& trial : trials) squares += std::pow(trial.thirds[i].mean - mean, 2);
    sum += weight * squares / (n - 1.0);
    seen += 1.0;
  }
  if (seen < kFewestThirds) return std::nullopt;
  const double of_pixel_px2 = sum / (seen - kOfDesk);  // as if each pixel had an error of its own
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
