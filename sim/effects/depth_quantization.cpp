#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply(Setup& setup, const EffectSetting& setting) {
  if (setting.values[0] >= 0.5) setup.rig.sensor.quantized = true;
}

}  // namespace

Effect depth_quantization() {
  return {.id = "depth_quantization",
          .family = "sensor",
          .sentence = "Depths come in steps of 1/8 px of disparity and are cut to whole millimetres.",
          .parameters = {{"law", "1: the device's law, 0: none", 0.0, 1.0, 0.0, 1.0}},
          .citation = "OpenNI's shift-to-depth table; the law holds for every point of recorded frames",
          .twins = {"disparity_offset"},
          .discriminated_by = "the comb of the fractional disparities of any cloud",
          .apply = apply};
}

}  // namespace fathom::effects
