#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_colour_registration(Setup& setup, const EffectSetting& setting) {
  if (setting.values[0] >= 0.5) setup.processing.colour_view = true;
}

}  // namespace

Effect colour_registration() {
  return {
      .id = "colour_registration",
      .family = "processing",
      .sentence =
          "Depths were moved to where the colour camera, 25 mm beside, has them, so that shadows lie on both sides.",
      .parameters = {{"registered", "1: they were, 0: not", 0.0, 1.0, 0.0, 1.0, {}, 1.0}},
      .citation = "OpenNI's depth-to-colour registration",
      .confounded = {"cup_placement", "principal_point"},
      .discriminated_by = "shadows of things on the desk: 75 mm of baseline on one side, or 50 and 25 mm on two",
      .apply = apply_colour_registration};
}

}  // namespace fathom::effects
