// Where a liquid's surface ends: inside the wall, so that no light slips between the two.
#pragma once

#include <functional>
#include <span>

#include "sim/scene/mesh.h"
#include "sim/scene/plane_section.h"

namespace fathom {

/// Moves the edge of a level mesh outwards: half-way through the wall behind it, at most 0.25 mm. The wall behind an
/// edge ends at the next of `walls`, the section at the mesh's height; where there is none, or `open` says that a point
/// [m] half-way lies in the air, the wall is a single sheet, and the edge moves by 2 µm, above the rounding of float
/// coordinates of a metre.
void draw_into_walls(std::span<const Segment> walls, const std::function<bool(const Eigen::Vector2d&)>& open,
                     Mesh& mesh);

}  // namespace fathom
