#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_wrong_cup(Setup& setup, const EffectSetting& setting) {
  for_each_cup(setup, [&](Cup&, CupShape& shape) {
    for (Eigen::Vector2d& point : shape.inner) point *= 1.0 + setting.values[0];
    for (Eigen::Vector2d& point : shape.outer) point *= 1.0 + setting.values[0];
  });
}

}  // namespace

Effect wrong_cup() {
  return {
      .id = "wrong_cup",
      .family = "book-keeping",
      .sentence = "Another cup stands there, of the same form in another size.",
      .parameters = {{"scale", "the cup's lengths are 1 plus this times those of the right one", 0.0, 0.1, -0.5, 1.0}},
      .citation =
          "camera-calibration practice: a missing effect is often a mistake in the protocol (Kalibr, issues 561 and "
          "722)",
      .confounded = {"cup_bottom_height"},
      .discriminated_by = "a ruler",
      .apply = apply_wrong_cup};
}

}  // namespace fathom::effects
