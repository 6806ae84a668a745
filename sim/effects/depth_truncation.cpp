#include "core/units.h"
#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_depth_truncation(Setup& setup, const EffectSetting& setting) {
  if (setting.values[0] >= 0.5) setup.rig.sensor.cut = kMetresPerMm;
}

}  // namespace

Effect depth_truncation() {
  return {.id = "depth_truncation",
          .family = "sensor",
          .sentence = "Depths are cut to whole millimetres, so all read short by half of one.",
          .parameters = {{"cut", "1: to whole millimetres, 0: not", 0.0, 1.0, 0.0, 1.0}},
          .citation = "OpenNI's shift-to-depth table holds whole millimetres",
          .confounded = {"disparity_offset", "sensor_height"},
          .discriminated_by = "the comb of the depths themselves",
          .apply = apply_depth_truncation};
}

}  // namespace fathom::effects
