// The effects that this version knows, in one explicit table.
#pragma once

#include "sim/effects/effect.h"

namespace fathom {

const std::vector<Effect>& effect_registry();
std::vector<std::string> effect_ids();
/// Nothing when there is none of that id.
const Effect* find_effect(std::string_view id);

}  // namespace fathom
