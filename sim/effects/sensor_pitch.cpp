#include "core/units.h"
#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_sensor_pitch(Setup& setup, const EffectSetting& setting) {
  const Eigen::AngleAxisd down(-radians_from_deg(setting.values[0]), Eigen::Vector3d::UnitX());
  turn_camera(setup.rig, down.toRotationMatrix());
}

}  // namespace

Effect sensor_pitch() {
  return {.id = "sensor_pitch",
          .family = "sensor",
          .sentence = "The sensor looks further down than was measured.",
          .more = "the sensor looks {} further down than was measured",
          .less = "the sensor looks {} less far down than was measured",
          .parameters = {{"pitch_deg", "added to the angle below the horizontal", 0.0, 0.1, -5.0, 5.0}},
          .citation = "Khoshelham & Elberink 2012, Sensors 12, 1437: exterior orientation in the error budget",
          .confounded = {"sensor_height", "principal_point"},
          .discriminated_by = "bare-desk views: the fitted desk is pitched",
          .apply = apply_sensor_pitch};
}

}  // namespace fathom::effects
