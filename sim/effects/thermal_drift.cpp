#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_thermal_drift(Setup& setup, const EffectSetting& setting) {
  UnitModel& unit = setup.rig.sensor.unit;
  unit.warm_up_px += setting.values[0];
  unit.on_for_s = setup.circumstances.time_s;
  unit.disparity_offset_px += setting.values[1];
}

}  // namespace

Effect thermal_drift() {
  return {.id = "thermal_drift",
          .family = "sensor",
          .sentence = "The sensor warms up: its disparities start too large and settle.",
          .more = "the sensor's disparities start {} larger than they settle, as it warms up",
          .less = "the sensor's disparities start {} smaller than they settle, as it warms up",
          .parameters = {{"start_px", "too much when the session begins; falls to 1/e in 940 s", 0.0, 0.1, -3.0, 3.0},
                         {"settled_px", "too much ever after: the rig was measured before the sensor was warm", 0.0,
                          0.1, -3.0, 3.0}},
          .citation = "one Kinect v1, measured: 8 mm in 6 min at 2.5 m; unit_model.h",
          .confounded = {"disparity_offset", "evaporation"},
          .discriminated_by = "the same bare desk at the beginning and the end of a session",
          .apply = apply_thermal_drift,
          .of_time = true};
}

}  // namespace fathom::effects
