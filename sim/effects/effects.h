// The effects of the registry: those of a few lines stand in a table for each family, those whose physics takes more
// have a file of their own, which their family's table names. A new one: docs/extending.md.
#pragma once

#include "sim/effects/effect.h"

namespace fathom::effects {

std::vector<Effect> sensor_effects();
std::vector<Effect> liquid_effects();
std::vector<Effect> surface_effects();
std::vector<Effect> cup_effects();
std::vector<Effect> light_effects();
std::vector<Effect> bookkeeping_effects();
std::vector<Effect> processing_effects();

Effect stratification();
Effect ripples();
Effect concave_bottom();

}  // namespace fathom::effects
