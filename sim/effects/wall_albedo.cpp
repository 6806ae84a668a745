#include <algorithm>

#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_wall_albedo(Setup& setup, const EffectSetting& setting) {
  for_each_cup(setup,
               [&](Cup&, CupShape& shape) { shape.albedo = std::clamp(shape.albedo + setting.values[0], 0.0, 1.0); });
}

}  // namespace

Effect wall_albedo() {
  return {.id = "wall_albedo",
          .family = "cup",
          .sentence = "The cup reflects more infrared light than its model.",
          .more = "the cup's albedo is {} higher than the model's",
          .less = "the cup's albedo is {} lower than the model's",
          .parameters = {{"albedo", "added to the cup's albedo", 0.0, 0.1, -0.7, 0.3}},
          .citation = "Hara et al. 2014 do not give the cup's colour; 0.70 is assumed",
          .confounded = {"absorption", "wall_multipath"},
          .discriminated_by = "the empty cup's brightness beside the desk's",
          .apply = apply_wall_albedo};
}

}  // namespace fathom::effects
