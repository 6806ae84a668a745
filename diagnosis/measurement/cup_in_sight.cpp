#include "diagnosis/measurement/cup_in_sight.h"

#include <cmath>
#include <numbers>

#include "core/units.h"
#include "detector/plane.h"
#include "diagnosis/measurement/cup_regions.h"

namespace fathom {

double share_in_image(const Eigen::Vector2d& cup, const LaboratoryRig& rig) {
  const Eigen::Isometry3d camera_from_desk =
      desk_from_camera(plane_from({rig.height_m, rig.pitch_rad, rig.roll_rad})).inverse();
  constexpr int kAround = 8;
  int points = 0, seen = 0;
  for (const double height : {0.0, rig.cup.height()})
    for (int i = 0; i < kAround; ++i, ++points) {
      const double azimuth = 2.0 * std::numbers::pi * i / kAround, radius = rig.cup.outer_radius(height);
      const Eigen::Vector3d point =
          camera_from_desk * Eigen::Vector3d(cup.x() + 0.5 * rig.baseline_m + radius * std::cos(azimuth),
                                             cup.y() + radius * std::sin(azimuth), height);
      seen += point.z() > 0.0 && rig.focal_px * std::abs(point.x()) < 0.5 * kImageWidth_px * point.z() &&
              rig.focal_px * std::abs(point.y()) < 0.5 * kImageHeight_px * point.z();
    }
  return static_cast<double>(seen) / points;
}

double pixels_in_sight(const Eigen::Vector2d& cup, double fill, const LaboratoryRig& rig) {
  constexpr double kLift = 1.0 / 3.0;
  constexpr int kAcross = 30;
  const double height = rig.cup.bottom() + kLift * fill, radius = interior_radius(rig.cup);
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

double height_per_px_mm(const Eigen::Vector2d& cup, const LaboratoryRig& rig) {
  const Eigen::Vector3d camera_to_bottom(cup.x() + 0.5 * rig.baseline_m, cup.y(), rig.cup.bottom() - rig.height_m);
  const double depth = camera_to_bottom.y() * std::cos(rig.pitch_rad) - camera_to_bottom.z() * std::sin(rig.pitch_rad);
  const double too_deep = depth * depth / (rig.focal_px * rig.baseline_m);
  return mm_from_metres(too_deep * -camera_to_bottom.z() / depth);
}

}  // namespace fathom
