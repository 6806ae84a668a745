// Things of a scene that stand in one another.
#pragma once

#include <optional>
#include <string>

#include "sim/scene/geometry.h"
#include "sim/scene/scene.h"

namespace fathom {

/// What is nearer than this [m] to standing apart touches.
inline constexpr double kTouching = 2e-4;

struct Overlap {
  std::string one, other;  ///< "/cups/0", "/objects/2"
};

/// The first two cups or objects of the scene that stand in one another: whose surfaces cross, and go on crossing when
/// one of them is moved by kTouching along any axis; or of which one lies within a solid. A thing may stand in a cup,
/// in a bowl, or in a room that is a glTF file. `geometry` is build_geometry()'s of the scene; what effects have added
/// to it behind the scene's own cups and objects, like a second layer of a liquid, is not looked at.
std::optional<Overlap> find_overlap(const Scene& scene, const Geometry& geometry);

}  // namespace fathom
