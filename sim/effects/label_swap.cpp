#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_label_swap(Setup& setup, const EffectSetting& setting) {
  const std::vector<Medium>& liquids = setup.circumstances.liquids;
  if (setting.values[0] < 0.5 || liquids.size() < 2) return;
  for_each_filling(setup, setting, [&](Cup&, Filling& filling) {
    if (filling.medium.name == liquids[0].name)
      filling.medium = liquids[1];
    else if (filling.medium.name == liquids[1].name)
      filling.medium = liquids[0];
  });
}

}  // namespace

Effect label_swap() {
  return {.id = "label_swap",
          .family = "book-keeping",
          .sentence = "The labels of the first two liquids are swapped.",
          .parameters = {{"swapped", "1: swapped, 0: right", 0.0, 1.0, 0.0, 1.0}},
          .citation =
              "camera-calibration practice: a missing effect is often a mistake in the protocol (Kalibr, issues 561 "
              "and 722)",
          .confounded = {"subsurface_scattering", "refractive_index"},
          .discriminated_by = "looking into the cups",
          .apply = apply_label_swap};
}

}  // namespace fathom::effects
