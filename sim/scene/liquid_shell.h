// Sides and underside of a liquid in a clear cup of revolution, just inside the wall, where the solid wins.
#pragma once

#include "sim/scene/liquid_top.h"

namespace fathom {

/// Closes the body under `top`, whose mesh is `surface`. Both about the axis at the origin.
Mesh liquid_shell(const CupShape& shape, const LiquidTop& top, const Mesh& surface);

}  // namespace fathom
