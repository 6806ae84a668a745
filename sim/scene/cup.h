// Cups of every kind as the rest of the program needs them: bodies, how much they hold, the surface of what is in them.
#pragma once

#include "sim/scene/scene.h"

namespace fathom {

/// "paper_cup", "mug.glb"
const std::string& cup_name(const Cup& cup);

/// Pose of a cup of revolution, whose own frame has the axis at the origin and the desk at 0.
Pose world_from_shape(const Cup& cup);

/// Of the frame in which the cup is described: its own, or its glTF file's, z up.
Pose world_from_cup(const Cup& cup);

/// Whether light enters the cup's wall, or part of it.
bool is_clear(const Cup& cup);

/// The cup's meshes in the world, a glazed one's smooth between their edges; a clear cup of revolution has walls
/// instead (cup_mesh.h).
std::vector<GltfPart> cup_parts(const Cup& cup);

/// Greatest depth of a liquid [m], its volume [m³], and the volume at any depth. A cup from a mesh must have its
/// cavity.
double cup_depth(const Cup& cup);
double cup_capacity(const Cup& cup);
double cup_volume(const Cup& cup, double depth);
/// The depth [m] at which a cup holds `volume` [m³], from 0 to its capacity; see Cavity::level_of.
double depth_of_volume(const Cup& cup, double volume);

/// Height [m] of the liquid's surface above the desk, in a brimful cup 10 µm lower, and the surface itself in the
/// world, drawn half-way into the wall. The cup must have a filling.
double liquid_level(const Cup& cup);
Mesh liquid_surface(const Cup& cup);

}  // namespace fathom
