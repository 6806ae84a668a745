#include "core/units.h"
#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_baseline(Setup& setup, const EffectSetting& setting) {
  const double more = metres_from_mm(setting.values[0]);
  keep_calibration(setup.rig.sensor);
  setup.rig.sensor.baseline += more;
  setup.rig.world_from_camera.translation() -= 0.5 * more * setup.rig.world_from_camera.linear().col(0);
}

}  // namespace

Effect baseline() {
  return {.id = "baseline",
          .family = "sensor",
          .sentence = "Camera and projector stand farther apart than the device takes for granted.",
          .more = "camera and projector stand {} farther apart than the device takes for granted",
          .less = "camera and projector stand {} nearer together than the device takes for granted",
          .parameters = {{"baseline_mm", "added to the baseline", 0.0, 0.1, -5.0, 5.0}},
          .citation = "Khoshelham & Elberink 2012, Sensors 12, 1437: baseline among the calibration parameters",
          .confounded = {"focal_length", "disparity_offset"},
          .discriminated_by = "other distances of the desk: an error of scale vanishes at the reference plane",
          .apply = apply_baseline};
}

}  // namespace fathom::effects
