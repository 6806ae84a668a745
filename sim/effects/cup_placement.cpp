#include "core/units.h"
#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_cup_placement(Setup& setup, const EffectSetting& setting) {
  for (Cup& cup : setup.scene.cups)
    cup.position += Eigen::Vector2d(metres_from_mm(setting.values[0]), metres_from_mm(setting.values[1]));
}

}  // namespace

Effect cup_placement() {
  return {.id = "cup_placement",
          .family = "cup",
          .sentence = "The cup stands beside the place that was written down, always by as much.",
          .parameters = {{"x_mm", "to the sensor's right", 0.0, 2.0, -30.0, 30.0},
                         {"y_mm", "away from the sensor", 0.0, 2.0, -30.0, 30.0}},
          .citation = "Hara et al. 2014 place cups by hand at marks on the desk",
          .confounded = {"sensor_pitch", "sensor_roll"},
          .discriminated_by = "the cup's outline in the cloud",
          .apply = apply_cup_placement};
}

}  // namespace fathom::effects
