#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_disparity_offset(Setup& setup, const EffectSetting& setting) {
  setup.rig.sensor.unit.disparity_offset_px += setting.values[0];
}

}  // namespace

Effect disparity_offset() {
  return {
      .id = "disparity_offset",
      .family = "sensor",
      .sentence = "The device reads all disparities too large by the same amount.",
      .more = "the device reads all disparities {} too large",
      .less = "the device reads all disparities {} too small",
      .parameters = {{"offset_px", "added to every disparity", 0.0, 0.1, -3.0, 3.0}},
      .citation =
          "Khoshelham & Elberink 2012, Sensors 12, 1437: the linear normalisation of the raw disparity has an offset",
      .confounded = {"baseline", "focal_length", "sensor_height", "thermal_drift"},
      .discriminated_by = "other heights of the sensor above the bare desk",
      .apply = apply_disparity_offset};
}

}  // namespace fathom::effects
