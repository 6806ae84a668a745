// Rigid transformations, named by their frames: point_in_a = a_from_b * point_in_b.
#pragma once

#include <Eigen/Geometry>

namespace fathom {

using Pose = Eigen::Isometry3d;

/// A half-line; `direction` has unit length unless said otherwise.
struct Ray {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;
};

}  // namespace fathom
