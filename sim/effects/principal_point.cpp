#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_principal_point(Setup& setup, const EffectSetting& setting) {
  keep_calibration(setup.rig.sensor);
  setup.rig.sensor.principal_px += Eigen::Vector2d(setting.values[0], setting.values[1]);
}

}  // namespace

Effect principal_point() {
  return {.id = "principal_point",
          .family = "sensor",
          .sentence = "The optical axis meets the image elsewhere than the device takes for granted.",
          .parameters = {{"x_px", "to the right", 0.0, 2.0, -20.0, 20.0}, {"y_px", "downward", 0.0, 2.0, -20.0, 20.0}},
          .citation = "Khoshelham & Elberink 2012, Sensors 12, 1437: principal point among the calibration parameters",
          .confounded = {"sensor_pitch", "sensor_roll"},
          .discriminated_by = "a target of known places on the desk",
          .apply = apply_principal_point};
}

}  // namespace fathom::effects
