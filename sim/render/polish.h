// From Embree's triangle to the surface that it stands for, in double.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/pose.h"
#include "sim/scene/geometry.h"

namespace fathom {

struct SurfacePoint {
  double distance;         ///< [m] along the ray
  Eigen::Vector3d normal;  ///< unit, outward
};

/// The crossing of `ray` with the smooth shape of `surface` near its crossing with a triangle at `distance`, whose unit
/// normal is `facet_normal`. Nothing where the ray passes the shape by.
std::optional<SurfacePoint> polish(const Surface& surface, unsigned triangle, const Eigen::Vector3d& facet_normal,
                                   const Ray& ray, double distance);

/// d normal / d point [1/m] for the outward normal of `surface` at a point on it.
Eigen::Matrix3d outward_curvature(const Surface& surface, unsigned triangle, const Eigen::Vector3d& point);

}  // namespace fathom
