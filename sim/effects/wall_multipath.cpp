#include <algorithm>

#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_wall_multipath(Setup& setup, const EffectSetting& setting) {
  setup.light.interreflected = std::max(setup.light.interreflected, setting.values[0]);
}

}  // namespace

Effect wall_multipath() {
  return {.id = "wall_multipath",
          .family = "light",
          .sentence = "Light that the walls throw on brightens the bottom and drowns its dots.",
          .parameters = {{"share", "of the interreflection, 1: all of it", 0.0, 1.0, 0.0, 1.0}},
          .citation = "Gupta et al. 2011, CVPR: structured light under global illumination",
          .confounded = {"wall_albedo"},
          .discriminated_by = "the projector's picture with a mask that lights the bottom alone; a black cup",
          .apply = apply_wall_multipath};
}

}  // namespace fathom::effects
