// Rigid transformations, named by their frames: point_in_a = a_from_b * point_in_b.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

namespace fathom {

using Pose = Eigen::Isometry3d;

/// Unit vector in the xy plane at an angle [rad] from +x towards +y.
inline Eigen::Vector2d direction_of(double azimuth) { return {std::cos(azimuth), std::sin(azimuth)}; }

/// A half-line; `direction` has unit length unless said otherwise.
struct Ray {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;
};

}  // namespace fathom
