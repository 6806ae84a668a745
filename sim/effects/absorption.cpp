#include <algorithm>

#include "core/units.h"
#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_absorption(Setup& setup, const EffectSetting& setting) {
  for_each_filling(setup, setting, [&](Cup&, Filling& filling) {
    filling.medium.absorption = std::max(filling.medium.absorption + per_metre_from_per_mm(setting.values[0]), 0.0);
  });
}

}  // namespace

Effect absorption() {
  return {.id = "absorption",
          .family = "liquid",
          .sentence = "The liquid swallows more infrared light than its table says, or less.",
          .more = "the liquid's absorption coefficient is {} higher than its table says",
          .less = "the liquid's absorption coefficient is {} lower than its table says",
          .parameters = {{"absorption_per_mm", "added to the absorption coefficient, which stays at 0 or above", 0.0,
                          0.005, -0.05, 1.0}},
          .citation = "Kou, Labrie & Chylek 1993, Applied Optics 32, 3531: water's absorption in the near infrared",
          .confounded = {"wall_albedo"},
          .discriminated_by = "two fills of the same liquid: absorption grows with the path, an albedo does not",
          .apply = apply_absorption,
          .of_liquids = true};
}

}  // namespace fathom::effects
