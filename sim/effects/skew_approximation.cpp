#include <algorithm>

#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_skew_approximation(Setup& setup, const EffectSetting& setting) {
  setup.processing.bisector = std::max(setup.processing.bisector, setting.values[0]);
}

}  // namespace

Effect skew_approximation() {
  return {.id = "skew_approximation",
          .family = "processing",
          .sentence = "Raised bottoms were reduced by the paper's closed form, not by exact triangulation.",
          .parameters = {{"share", "of the closed form, 1: all of it", 0.0, 1.0, 0.0, 1.0}},
          .citation = "Hara et al. 2014, Eq. 3 to 7: both rays at one incidence, the sensor's height for the point's",
          .confounded = {"refractive_index"},
          .discriminated_by = "clouds instead of tables of reduced heights",
          .apply = apply_skew_approximation};
}

}  // namespace fathom::effects
