#include "core/units.h"
#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_meniscus(Setup& setup, const EffectSetting& setting) {
  if (setting.values[0] == 90.0) return;
  for_each_filling(setup, setting, [&](Cup&, Filling& filling) {
    filling.form.wetting = Wetting{radians_from_deg(setting.values[0]), metres_from_mm(2.73)};
  });
}

}  // namespace

Effect meniscus() {
  return {.id = "meniscus",
          .family = "surface",
          .sentence = "The liquid climbs the wall, or is pushed down there, so its surface is curved.",
          .parameters = {{"contact_angle_deg", "in the liquid, at the wall; 90: level", 90.0, 30.0, 10.0, 170.0}},
          .citation = "Landau & Lifshitz, Fluid Mechanics, section 61; capillary length of water 2.73 mm",
          .confounded = {"concave_bottom"},
          .discriminated_by = "ring regions against the centre, and an opaque liquid, whose surface is seen itself",
          .apply = apply_meniscus,
          .of_liquids = true};
}

}  // namespace fathom::effects
