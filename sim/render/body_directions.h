// The directions in which a source sees the boundaries of clear bodies.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/optics/ray_differential.h"
#include "sim/scene/geometry.h"

namespace fathom {

inline constexpr double kDirectionSpacing = 2e-3;  ///< [rad] 1.3 mm from the sensor's height

/// One cell of a grid of directions.
struct DirectionCell {
  Eigen::Vector3d middle;  ///< unit
  Matrix32d across;        ///< spans the grid's plane, a unit away along its axis
  double along;            ///< cosine of the middle to that axis

  /// The direction `steps` of a cell's width off its middle, unit.
  Eigen::Vector3d at(const Eigen::Vector2d& steps) const {
    return (middle / along + kDirectionSpacing * (across * steps)).normalized();
  }
  double solid_angle() const { return kDirectionSpacing * kDirectionSpacing * along * along * along; }  ///< [sr]
};

/// The cells of a gnomonic grid that contain boundaries of clear bodies, always in the same order.
std::vector<DirectionCell> directions_to_bodies(const Geometry& geometry, const Eigen::Vector3d& source);

}  // namespace fathom
