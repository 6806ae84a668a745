#include "core/units.h"
#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply(Setup& setup, const EffectSetting& setting) { setup.rig.sensor.cut += metres_from_mm(setting.values[0]); }

}  // namespace

Effect depth_truncation() {
  return {.id = "depth_truncation",
          .family = "sensor",
          .sentence = "Depths are cut to whole units, not rounded, so all read short by half of one.",
          .parameters = {{"cut_mm", "added to the unit", 0.0, 1.0, 0.0, 10.0}},
          .citation = "OpenNI's shift-to-depth table holds whole millimetres",
          .twins = {"disparity_offset", "sensor_height"},
          .discriminated_by = "the comb of the depths themselves",
          .apply = apply};
}

}  // namespace fathom::effects
