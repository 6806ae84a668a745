#include "core/units.h"
#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply(Setup& setup, const EffectSetting& setting) {
  if (setting.values[0] == 0.0) return;
  for_each_filling(setup, setting, [&](Cup&, Filling& filling) {
    filling.form.ripples.push_back(
        {.wavelength = 0.015, .amplitude = metres_from_mm(setting.values[0]), .azimuth = 0.0, .phase = 0.0});
  });
}

}  // namespace

Effect ripples() {
  return {.id = "ripples",
          .family = "surface",
          .sentence = "Standing waves of 15 mm run over the liquid's surface.",
          .parameters = {{"amplitude_mm", "of the waves", 0.0, 0.1, -2.0, 2.0}},
          .citation = "Landau & Lifshitz, Fluid Mechanics, section 62: capillary-gravity waves",
          .twins = {"surface_tilt", "meniscus"},
          .discriminated_by = "trials spread over time: waves die out",
          .apply = apply,
          .of_liquids = true};
}

}  // namespace fathom::effects
