// Cups as meshes: profiles of revolution, handles, and the flat surface of a liquid.
#pragma once

#include <optional>
#include <vector>

#include "sim/scene/mesh.h"
#include "sim/scene/scene.h"

namespace fathom {

/// The solid between outer and inner profile, with its handle, axis at the origin, standing on z = 0.
Mesh cup_mesh(const CupShape& shape);

/// Distance [m] from the axis of the wall's middle where a handle's reach begins, of a shape that has one.
double handle_wall(const CupShape& shape);

/// The handle of a shape that has one.
Mesh handle_mesh(const CupShape& shape);

/// The same solid, without a handle, as one surface for each straight piece of its profiles; with `sink` [m] its
/// underside reaches that far below z = 0.
struct WallPart {
  Mesh mesh;
  std::optional<Eigen::Vector2d> cone;  ///< radius at height 0 and its slope; nothing for a level ring
};
std::vector<WallPart> wall_parts(const CupShape& shape, double sink);

/// A level disc at `height` [m] above the desk that reaches half-way into the wall: bodies overlap, the solid wins.
Mesh liquid_disc(const CupShape& shape, double height);

}  // namespace fathom
