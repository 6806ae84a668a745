#include <algorithm>

#include "core/units.h"
#include "sim/effects/changes.h"
#include "sim/effects/effects.h"
#include "sim/scene/cup.h"

namespace fathom::effects {
namespace {

void apply_foam(Setup& setup, const EffectSetting& setting) {
  if (setting.values[0] == 0.0) return;
  for_each_filling(setup, setting, [&](Cup& cup, Filling& filling) {
    const double room = cup_depth(cup) - filling.depth;
    filling.depth += std::min(metres_from_mm(setting.values[0]), room);
    filling.medium.scattering = per_metre_from_per_mm(1000.0);
    filling.medium.anisotropy = 0.0;
  });
}

}  // namespace

Effect foam() {
  return {
      .id = "foam",
      .family = "surface",
      .sentence = "Foam lies on the liquid and is what the sensor sees.",
      .more = "foam of {} lies on the liquid and is what the sensor sees",
      .parameters = {{"thickness_mm", "of the foam", 0.0, 1.0, 0.0, 20.0}},
      .citation = "Vera & Durian 1996, Physical Review E 53, 3215: foam scatters within a few bubbles, so it is opaque",
      .confounded = {"fill_offset", "evaporation"},
      .discriminated_by = "the same pour after the foam has gone",
      .apply = apply_foam,
      .of_liquids = true};
}

}  // namespace fathom::effects
