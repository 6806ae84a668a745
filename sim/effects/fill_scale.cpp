#include <algorithm>

#include "sim/effects/changes.h"
#include "sim/effects/effects.h"
#include "sim/scene/cup.h"

namespace fathom::effects {
namespace {

void apply_fill_scale(Setup& setup, const EffectSetting& setting) {
  for_each_filling(setup, setting, [&](Cup& cup, Filling& filling) {
    filling.depth = std::clamp(filling.depth * (1.0 + setting.values[0]), 0.0, cup_depth(cup));
  });
}

}  // namespace

Effect fill_scale() {
  return {.id = "fill_scale",
          .family = "book-keeping",
          .sentence = "Every pour holds more than was written down, in proportion.",
          .more = "every pour is {} larger than was written down",
          .less = "every pour is {} smaller than was written down",
          .in_percent = true,
          .parameters = {{"scale", "fills are 1 plus this times what was written", 0.0, 0.03, -0.9, 2.0}},
          .citation = "Hara et al. 2014 pour to marks of 10, 20 and 30 mm",
          .confounded = {"refractive_index", "unit_error"},
          .discriminated_by = "weighing the cup at two fills",
          .apply = apply_fill_scale,
          .of_liquids = true};
}

}  // namespace fathom::effects
