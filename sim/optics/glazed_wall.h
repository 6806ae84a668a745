// A glazed wall in the world: what it sends from one direction to another, and what becomes of a walker there.
#pragma once

#include <Eigen/Core>
#include <numbers>

#include "sim/optics/glaze.h"
#include "sim/optics/random_walk.h"
#include "sim/optics/ray_differential.h"

namespace fathom {

/// The axes of the frame in which a glaze is asked, as columns: two along the surface and its unit normal.
inline Eigen::Matrix3d surface_axes(const Eigen::Vector3d& normal) {
  Eigen::Matrix3d axes;
  axes << perpendicular_to(normal), normal;
  return axes;
}

/// π · BRDF for light that comes from `from` and goes to `to`, unit directions away from the wall: 1 for a white
/// diffuse wall.
inline double reflectance_factor(const Glaze& glaze, const Eigen::Vector3d& normal, const Eigen::Vector3d& from,
                                 const Eigen::Vector3d& to) {
  const Eigen::Matrix3d axes = surface_axes(normal);
  return std::numbers::pi * glaze.reflection(axes.transpose() * from, axes.transpose() * to);
}

/// Sends the walker on; false when the wall takes it up.
inline bool bounce_off_glaze(Walker& walker, const Eigen::Vector3d& normal, const Glaze& glaze, Rng& rng) {
  const Eigen::Matrix3d axes = surface_axes(normal);
  const std::optional<GgxSample> sent = glaze.sample(-(axes.transpose() * walker.direction), rng);
  if (!sent) return false;
  walker.weight *= sent->weight;
  walker.direction = (axes * sent->to).normalized();
  return true;
}

}  // namespace fathom
