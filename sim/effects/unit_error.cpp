#include <algorithm>

#include "sim/effects/changes.h"
#include "sim/effects/effects.h"
#include "sim/scene/cup.h"

namespace fathom::effects {
namespace {

void apply_unit_error(Setup& setup, const EffectSetting& setting) {
  for_each_filling(setup, setting, [&](Cup& cup, Filling& filling) {
    filling.depth = std::min(filling.depth * setting.values[0], cup_depth(cup));
  });
}

}  // namespace

Effect unit_error() {
  return {.id = "unit_error",
          .family = "book-keeping",
          .sentence = "Fills were written down in another unit than millimetres.",
          .parameters = {{"factor", "millimetres in what was taken for one: inch 25.4, centimetre 10", 1.0, 0.5, 0.03,
                          30.0}},
          .citation =
              "camera-calibration practice: a missing effect is often a mistake in the protocol (Kalibr, issues 561 "
              "and 722)",
          .confounded = {"fill_scale"},
          .discriminated_by = "reading the marks again",
          .apply = apply_unit_error,
          .of_liquids = true};
}

}  // namespace fathom::effects
