#include <cmath>

#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_depth_wander(Setup& setup, const EffectSetting& setting) {
  UnitModel& unit = setup.rig.sensor.unit;
  unit.wander_px = std::hypot(unit.wander_px, setting.values[0]);
  unit.on_for_s = setup.circumstances.time_s;
}

}  // namespace

Effect depth_wander() {
  return {
      .id = "depth_wander",
      .family = "sensor",
      .sentence = "All disparities of a frame share an error that is another one in the next frame.",
      .more = "all disparities of a frame share an error of {}, another one in the next frame",
      .parameters = {{"sd_px", "standard deviation of the error", 0.0, 0.05, 0.0, 1.0}},
      .citation = "an empty pot's floor over three Kinect scenes: 0.6 mm where independent points would give 0.04 mm",
      .confounded = {"thermal_drift"},
      .discriminated_by = "many trials without touching anything: the desk itself moves from frame to frame",
      .apply = apply_depth_wander,
      .of_time = true};
}

}  // namespace fathom::effects
