#include "core/units.h"
#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_sensor_roll(Setup& setup, const EffectSetting& setting) {
  const Eigen::Vector3d sight = setup.rig.world_from_camera.linear().col(2);
  turn_camera(setup.rig, Eigen::AngleAxisd(radians_from_deg(setting.values[0]), sight).toRotationMatrix());
}

}  // namespace

Effect sensor_roll() {
  return {.id = "sensor_roll",
          .family = "sensor",
          .sentence = "The sensor is turned about its line of sight.",
          .more = "the sensor is turned clockwise by {} about its line of sight",
          .less = "the sensor is turned anticlockwise by {} about its line of sight",
          .parameters = {{"roll_deg", "added to the roll, clockwise", 0.0, 0.1, -5.0, 5.0}},
          .citation = "Khoshelham & Elberink 2012, Sensors 12, 1437: exterior orientation in the error budget",
          .confounded = {"surface_tilt"},
          .discriminated_by = "bare-desk views: the fitted desk is rolled",
          .apply = apply_sensor_roll};
}

}  // namespace fathom::effects
