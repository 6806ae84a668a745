#include <algorithm>
#include <cmath>

#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

constexpr double kCodePx = 0.125;

void apply_depth_quantization(Setup& setup, const EffectSetting& setting) {
  if (setting.values[0] >= 0.5) setup.rig.sensor.quantized = true;
  setup.rig.sensor.codes_per_step =
      std::max(setup.rig.sensor.codes_per_step, static_cast<int>(std::lround(setting.values[1] / kCodePx)));
}

}  // namespace

Effect depth_quantization() {
  return {.id = "depth_quantization",
          .family = "sensor",
          .sentence = "Depths come in steps of disparity, of 1/8 px or coarser, and are cut to whole millimetres.",
          .parameters = {{"law", "1: the device's law, 0: none", 0.0, 1.0, 0.0, 1.0},
                         {"step_px", "of disparity: whole eighths", kCodePx, 3.0 * kCodePx, kCodePx, 1.0, {}, kCodePx}},
          .citation = "OpenNI's shift-to-depth table; the law holds for every point of recorded frames",
          .confounded = {"disparity_offset"},
          .discriminated_by = "the comb of the fractional disparities of any cloud",
          .apply = apply_depth_quantization};
}

}  // namespace fathom::effects
