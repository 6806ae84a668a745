// Cups as meshes: profiles of revolution, handles, and the flat surface of a liquid.
#pragma once

#include "sim/scene/mesh.h"
#include "sim/scene/scene.h"

namespace fathom {

/// Facets around the axis. The sagitta of a 40 mm wall is then 40 mm · (1 − cos(π/256)) = 3 µm.
inline constexpr int kFacetsAround = 256;

/// The solid between outer and inner profile, with its handle, axis at the origin, standing on z = 0.
Mesh cup_mesh(const CupShape& shape);

/// A level disc at `height` [m] above the desk that reaches half-way into the wall: bodies overlap, the solid wins.
Mesh liquid_disc(const CupShape& shape, double height);

}  // namespace fathom
