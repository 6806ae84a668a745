#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_focal_length(Setup& setup, const EffectSetting& setting) {
  keep_calibration(setup.rig.sensor);
  setup.rig.sensor.focal_px += setting.values[0];
}

}  // namespace

Effect focal_length() {
  return {.id = "focal_length",
          .family = "sensor",
          .sentence = "The camera's focal length is longer than the device takes for granted.",
          .more = "the camera's focal length is {} longer than the device takes for granted",
          .less = "the camera's focal length is {} shorter than the device takes for granted",
          .parameters = {{"focal_px", "added to the focal length at 640 x 480", 0.0, 1.0, -30.0, 30.0}},
          .citation = "Khoshelham & Elberink 2012, Sensors 12, 1437: focal length among the calibration parameters",
          .confounded = {"baseline", "disparity_offset"},
          .discriminated_by = "a gauge of known width across the image: only the focal length scales it",
          .apply = apply_focal_length};
}

}  // namespace fathom::effects
