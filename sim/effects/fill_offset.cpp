#include <algorithm>

#include "core/units.h"
#include "sim/effects/changes.h"
#include "sim/effects/effects.h"
#include "sim/scene/cup.h"

namespace fathom::effects {
namespace {

void apply_fill_offset(Setup& setup, const EffectSetting& setting) {
  for_each_filling(setup, setting, [&](Cup& cup, Filling& filling) {
    filling.depth = std::clamp(filling.depth + metres_from_mm(setting.values[0]), 0.0, cup_depth(cup));
  });
}

}  // namespace

Effect fill_offset() {
  return {.id = "fill_offset",
          .family = "book-keeping",
          .sentence = "Every pour holds more than was written down, by as much each time.",
          .more = "every pour holds {} more than was written down",
          .less = "every pour holds {} less than was written down",
          .parameters = {{"fill_mm", "added to every fill", 0.0, 0.5, -50.0, 50.0}},
          .citation = "Hara et al. 2014 pour to marks of 10, 20 and 30 mm",
          .confounded = {"cup_bottom_height", "foam", "subsurface_scattering"},
          .discriminated_by = "weighing the cup, or an empty cup beside it",
          .apply = apply_fill_offset,
          .of_liquids = true};
}

}  // namespace fathom::effects
