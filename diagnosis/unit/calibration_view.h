// A desk or wall in clouds as a view of a unit's bias: residuals of disparity, cell by cell.
#pragma once

#include <optional>
#include <span>

#include "detector/plane.h"
#include "diagnosis/unit/bias_view.h"

namespace fathom {

/// How the device's pixels and disparities follow from its points.
struct DeviceScale {
  double focal_px = 570.342;  ///< of disparities f b / Z and of the infrared camera
  double baseline_m = 0.075;
  double camera_m = 0.0;  ///< what the clouds' camera stands to the right of the infrared one: 0.025, the colour camera
  double cut_m = 1e-3;    ///< depths are cut to whole multiples of this; 0: they are not

  /// f b / Z [px]; what was cut off is half a multiple in the mean.
  double disparity_px(double depth_m) const { return focal_px * baseline_m / (depth_m + 0.5 * cut_m); }
  /// In the depth image, principal point in its middle.
  Eigen::Vector2d pixel_px(const Eigen::Vector3f& point) const {
    return {focal_px * (point.x() + camera_m) / point.z() + 320.0, focal_px * point.y() / point.z() + 240.0};
  }
};

/// What a pose shows.
struct CalibrationView {
  BiasView view;
  Plane plane;
};

/// Of clouds of one pose, together. The plane is refitted from `guess` in disparity, where it is linear and noise is
/// even. What stands on the desk is none of it: points count within 0.6 px of the plane, then within 0.4 px of the mean
/// about them, so that a bias of the same size stays; cells where less than 0.6 of what is measured is desk are left
/// out. Nothing where fewer than twenty cells are left.
std::optional<CalibrationView> desk_view(std::span<const Points> clouds, const Plane& guess, const DeviceScale& scale);

}  // namespace fathom
