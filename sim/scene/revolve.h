// Bodies of revolution as meshes.
#pragma once

#include <vector>

#include "sim/scene/mesh.h"

namespace fathom {

/// Facets around the axis. The sagitta of a 40 mm wall is then 40 mm · (1 − cos(π/256)) = 3 µm.
inline constexpr int kFacetsAround = 256;

/// What a profile of (radius, height) [m] sweeps about the z axis. With `outward` the faces of a profile that rises
/// look away from the axis (or down), otherwise towards it (or up).
Mesh revolve(const std::vector<Eigen::Vector2d>& profile, bool outward);

}  // namespace fathom
