// Effects in files: {"name": …, parameters…, "liquid": …} in a scene's list and in a model's.
#pragma once

#include <filesystem>

#include "sim/effects/effect.h"

namespace fathom {

/// The set-up with the effects of its list switched on, in their order. Parameters that the list leaves out keep the
/// value at which they do nothing. Throws Error naming the set-up's file, the place in the list, and what is allowed.
Setup with_effects(Setup setup);

/// The list "effects" of a model file; what else stands there is no concern of a simulation. Throws Error.
Json effects_of_model(const std::filesystem::path& model);

/// The set-up with its own effects and then the model's.
Setup with_effects_of_model(Setup setup, const std::filesystem::path& model);

}  // namespace fathom
