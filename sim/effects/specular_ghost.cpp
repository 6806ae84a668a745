#include <algorithm>

#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_specular_ghost(Setup& setup, const EffectSetting& setting) {
  setup.light.mirrored = std::max(setup.light.mirrored, setting.values[0]);
}

}  // namespace

Effect specular_ghost() {
  return {.id = "specular_ghost",
          .family = "light",
          .sentence = "The liquid's surface mirrors dots onto the wall and walls into the camera.",
          .parameters = {{"share", "of the mirrored light, 1: all of it", 0.0, 1.0, 0.0, 1.0}},
          .citation = "Born & Wolf, Principles of Optics, section 1.5: 2 % at normal incidence, 6 % at 60 degrees",
          .confounded = {"wall_multipath"},
          .discriminated_by = "the sensor at another distance: mirror images move, the bottom does not",
          .apply = apply_specular_ghost};
}

}  // namespace fathom::effects
