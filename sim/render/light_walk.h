// Light that gets to the camera in more than one step: scattered in a body, thrown from wall to wall, totally
// reflected, out of a liquid and in again. A random walk from what the camera sees, joined to the projector wherever it
// scatters.
#pragma once

#include <functional>
#include <limits>

#include "core/rng.h"
#include "sim/optics/random_walk.h"
#include "sim/render/connection.h"

namespace fathom {

/// Light from the projector that ends in the camera, by the direction in which it left.
struct ReturnedLight {
  Eigen::Vector3d direction;  ///< unit, world
  double reflected;           ///< [1/m²] π · radiance per unit radiant intensity of the projector, see radiance_dn()
  double spread;              ///< [rad] how far around `direction` light is about as likely to return
};

/// Walks once from the point `seen` and calls `visit` with each ReturnedLight. Their sum is an estimate, unbiased but
/// for what without_forward_peak() changes: where a body that scatters is entered, of all that comes out of it; at a
/// diffuse point, of what arrives there other than from the projector or its mirror image in a liquid. Where little of
/// it gets to the camera, most walks end at once. `first`: how it begins; drawn if it is not given. `near` [m]: of
/// walks into a body, as in NearStart.
void walk_light(const PointLight& projector, const SeenPoint& seen, Rng& rng,
                const std::function<void(const ReturnedLight&)>& visit, const FirstStep* first = nullptr,
                double near = std::numeric_limits<double>::infinity());

}  // namespace fathom
