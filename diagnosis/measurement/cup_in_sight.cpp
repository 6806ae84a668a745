#include "diagnosis/measurement/cup_in_sight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/units.h"
#include "detector/plane.h"
#include "diagnosis/measurement/cup_regions.h"
#include "diagnosis/measurement/frame_estimates.h"

namespace fathom {

namespace {

/// Points around foot and rim, in the camera's frame.
std::vector<Eigen::Vector3d> foot_and_rim(const Eigen::Vector2d& cup, const LaboratoryRig& rig) {
  const Eigen::Isometry3d camera_from_desk =
      desk_from_camera(plane_from({rig.height_m, rig.pitch_rad, rig.roll_rad})).inverse();
  constexpr int kAround = 8;
  std::vector<Eigen::Vector3d> points;
  for (const double height : {0.0, rig.cup.height()})
    for (int i = 0; i < kAround; ++i) {
      const double azimuth = 2.0 * std::numbers::pi * i / kAround, radius = rig.cup.outer_radius(height);
      points.push_back(camera_from_desk * Eigen::Vector3d(cup.x() + 0.5 * rig.baseline_m + radius * std::cos(azimuth),
                                                          cup.y() + radius * std::sin(azimuth), height));
    }
  return points;
}

}  // namespace

Eigen::AlignedBox2d cup_in_image(const Eigen::Vector2d& cup, const LaboratoryRig& rig) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector3d& point : foot_and_rim(cup, rig)) {
    if (point.z() <= 0.0) return {};
    box.extend(pixel_of(rig, point));
  }
  return box;
}

double share_in_image(const Eigen::Vector2d& cup, const LaboratoryRig& rig) {
  const Eigen::AlignedBox2d image(Eigen::Vector2d::Zero(), Eigen::Vector2d(kImageWidth_px, kImageHeight_px));
  const std::vector<Eigen::Vector3d> points = foot_and_rim(cup, rig);
  const auto seen = std::count_if(points.begin(), points.end(), [&](const Eigen::Vector3d& point) {
    return point.z() > 0.0 && image.contains(pixel_of(rig, point));
  });
  return static_cast<double>(seen) / static_cast<double>(points.size());
}

double pixels_in_sight(const Eigen::Vector2d& cup, double height, const LaboratoryRig& rig) {
  constexpr int kAcross = 30;
  const double radius = interior_radius(rig.cup);
  const double opening = rig.cup.inner.back().x(), to_rim = (rig.cup.height() - height) / (rig.height_m - height);
  const Eigen::Isometry3d camera_from_desk =
      desk_from_camera(plane_from({rig.height_m, rig.pitch_rad, rig.roll_rad})).inverse();
  const Eigen::Vector2d camera(-cup.x() - 0.5 * rig.baseline_m, -cup.y());  // from the axis
  const Eigen::Vector2d projector = camera + Eigen::Vector2d(rig.baseline_m, 0.0);
  const double side = 2.0 * radius / kAcross;
  double pixels = 0.0;
  for (int i = 0; i < kAcross; ++i)
    for (int k = 0; k < kAcross; ++k) {
      const Eigen::Vector2d at((i + 0.5) * side - radius, (k + 0.5) * side - radius);
      const auto passes = [&](const Eigen::Vector2d& from) { return (at + to_rim * (from - at)).norm() < opening; };
      if (at.norm() > radius || !passes(camera) || !passes(projector)) continue;
      const Eigen::Vector2d from_foot = at - camera;
      const double depth = (camera_from_desk * Eigen::Vector3d(from_foot.x(), from_foot.y(), height)).z();
      pixels += rig.focal_px * rig.focal_px * side * side * (rig.height_m - height) / std::pow(depth, 3);
    }
  return pixels;
}

bool is_in_sight(const Eigen::Vector2d& cup, const LaboratoryRig& rig) {
  constexpr double kNear = 0.15, kNear_m = 0.1, kRounding_m = 1e-9;
  if (cup.y() < std::min(kNear * rig.height_m / std::tan(rig.pitch_rad), kNear_m) - kRounding_m) return false;
  return share_in_image(cup, rig) > 0.0;
}

std::string words_in_sight(const Eigen::Vector2d& cup, const LaboratoryRig& rig) {
  return fmt::format(
      "in mm and, with lateral_mm {:g}, where the sensor, {:g} mm high and pitched down by {:.4g} degrees, sees the "
      "cup",
      mm_from_metres(cup.x()), mm_from_metres(rig.height_m), deg_from_radians(rig.pitch_rad));
}

double height_per_px_mm(const Eigen::Vector2d& cup, const LaboratoryRig& rig) {
  const Eigen::Vector3d camera_to_bottom(cup.x() + 0.5 * rig.baseline_m, cup.y(), rig.cup.bottom() - rig.height_m);
  const double depth = camera_to_bottom.y() * std::cos(rig.pitch_rad) - camera_to_bottom.z() * std::sin(rig.pitch_rad);
  const double too_deep = depth * depth / (rig.focal_px * rig.baseline_m);
  return mm_from_metres(too_deep * -camera_to_bottom.z() / depth);
}

}  // namespace fathom
