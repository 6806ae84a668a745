// Things of a scene that stand in one another.
#pragma once

#include <optional>
#include <string>

#include "sim/scene/scene.h"
#include "sim/scene/setup.h"

namespace fathom {

/// What is nearer than this [m] to standing apart touches.
inline constexpr double kTouching = 2e-4;

struct Overlap {
  std::string one, other;  ///< "/cups/0", "/objects/2"
};

/// The first two cups or objects of the scene that stand in one another: whose surfaces cross, and go on crossing when
/// one of them is moved by kTouching along any axis; or of which one lies within a solid. A thing may stand in a cup,
/// in a bowl, or in a room that is a glTF file.
std::optional<Overlap> find_overlap(const Scene& scene, double wavelength_nm);

/// Throws Error where things stand in one another. Effects may add such things, like a second layer to a liquid: this
/// is for a scene as its file has it.
void require_apart(const Setup& setup);

}  // namespace fathom
