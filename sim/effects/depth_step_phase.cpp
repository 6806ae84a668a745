#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_depth_step_phase(Setup& setup, const EffectSetting& setting) {
  setup.rig.sensor.step_phase += setting.values[0];
}

}  // namespace

Effect depth_step_phase() {
  return {.id = "depth_step_phase",
          .family = "sensor",
          .sentence = "The steps of depth stand between those of the table that is taken for right.",
          .parameters = {{"phase_steps", "added to where depths lie between whole codes", 0.0, 0.5, 0.0, 1.0}},
          .citation = "two tables are in use, half a step apart: libfreenect and OpenNI, and the vendor's SDK",
          .confounded = {"disparity_offset"},
          .discriminated_by = "the comb of the fractional disparities of any cloud",
          .apply = apply_depth_step_phase};
}

}  // namespace fathom::effects
