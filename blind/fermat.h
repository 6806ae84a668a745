// The path that light takes between two points through a liquid's surface: the one of least time (Fermat 1662). No law
// of refraction is used; it follows.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "blind/world.h"

namespace fathom::blind {

/// Where the least path from `above` (in air) to `below` (in the liquid) meets the surface; both in the world. Nothing
/// when the search leaves the cup.
std::optional<Eigen::Vector3d> least_path(const World& world, const Eigen::Vector3d& above,
                                          const Eigen::Vector3d& below);

/// Its optical length through a point of the surface, which `least_path` minimises [m].
double optical_path(const World& world, const Eigen::Vector3d& above, const Eigen::Vector2d& crossing,
                    const Eigen::Vector3d& below);

/// Height at which the liquid's index changes when it is stratified.
double layer_height(const World& world);

}  // namespace fathom::blind
