// Light that a scattering body sends back to the camera: a random walk from the camera, joined to the projector through
// the body's surface at every scattering and at every diffuse wall that it meets.
#pragma once

#include <functional>

#include "core/rng.h"
#include "sim/render/connection.h"

namespace fathom {

/// Light from the projector that ends in the camera, by the direction in which it left.
struct ReturnedLight {
  Eigen::Vector3d direction;  ///< unit, world
  double reflected;           ///< [1/m²] π · radiance per unit radiant intensity of the projector, see radiance_dn()
};

/// Walks once through the body that a camera ray of direction `arriving` enters at `entry` and calls `visit` with each
/// ReturnedLight; their sum is an unbiased estimate of what the body sends back. What leaves the body is not followed
/// on: neither to walls above a liquid nor through a clear wall. `entry.entered` must be set.
void walk_turbid(const PointLight& projector, const SeenPoint& entry, const Eigen::Vector3d& arriving, Rng& rng,
                 const std::function<void(const ReturnedLight&)>& visit);

}  // namespace fathom
