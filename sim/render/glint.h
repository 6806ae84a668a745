// Glints: mirror images of a point of light in liquids and glass.
#pragma once

#include <vector>

#include "sim/render/shoot.h"

namespace fathom {

/// The ways on which the first clear body that light from `source` meets mirrors it to `eye`, a place in air, refracted
/// by whatever clear bodies come after. They are searched for from every triangle of the bodies' boundaries. What
/// interfaces within bodies mirror is left out.
std::vector<Connection> find_glints(const Intersector& world, const Source& source, const Eigen::Vector3d& eye);

}  // namespace fathom
