// Glints: mirror images of a point of light in liquids and glass.
#pragma once

#include <vector>

#include "sim/render/shoot.h"

namespace fathom {

/// The ways from `source` to `eye`, a place in air, on which one interface mirrors the light, in part or all of it, and
/// all others refract it or mirror all of it. They are searched for from every triangle of the bodies' boundaries.
std::vector<Connection> find_glints(const Intersector& world, const Source& source, const Eigen::Vector3d& eye);

}  // namespace fathom
