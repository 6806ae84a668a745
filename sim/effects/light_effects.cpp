// Effects of light that takes other ways.
#include <algorithm>

#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {

std::vector<Effect> light_effects() {
  return {
      {.id = "wall_multipath",
       .sentence = "Light that the walls throw on brightens the bottom and drowns its dots.",
       .parameters = {{"share", "of the interreflection, 1: all of it", 0.0, 1.0, 0.0, 1.0}},
       .citation = "Gupta et al. 2011, CVPR: structured light under global illumination",
       .confounded = {"wall_albedo"},
       .discriminated_by = "the projector's picture with a mask that lights the bottom alone; a black cup",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             setup.light.interreflected = std::max(setup.light.interreflected, setting.values[0]);
           }},
      {.id = "specular_ghost",
       .sentence = "The liquid's surface mirrors dots onto the wall and walls into the camera.",
       .parameters = {{"share", "of the mirrored light, 1: all of it", 0.0, 1.0, 0.0, 1.0}},
       .citation = "Born & Wolf, Principles of Optics, section 1.5: 2 % at normal incidence, 6 % at 60 degrees",
       .confounded = {"wall_multipath"},
       .discriminated_by = "the sensor at another distance: mirror images move, the bottom does not",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             setup.light.mirrored = std::max(setup.light.mirrored, setting.values[0]);
           }},
  };
}

}  // namespace fathom::effects
