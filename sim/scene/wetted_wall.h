// Where a liquid touches the clear wall of a mesh: the wall's triangles are the liquid's boundary there.
#pragma once

#include "sim/scene/cavity.h"
#include "sim/scene/gltf.h"

namespace fathom {

/// The two sides of a part that has been cut at a liquid's level; either may be empty.
struct WettedWall {
  GltfPart dry, wetted;
};

/// Cuts a part of a clear cup's wall, in the world, at `level` [m]. Below, those patches of it are wetted that look
/// into the liquid in `cavity`; a patch must not pass through another one, for it is asked at one place only.
WettedWall cut_at_liquid(const GltfPart& part, const Cavity& cavity, double level);

}  // namespace fathom
