#include "core/units.h"
#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_sensor_height(Setup& setup, const EffectSetting& setting) {
  setup.rig.world_from_camera.translation().z() += metres_from_mm(setting.values[0]);
}

}  // namespace

Effect sensor_height() {
  return {.id = "sensor_height",
          .family = "sensor",
          .sentence = "The sensor stands higher above the desk than was measured.",
          .more = "the sensor stands {} higher above the desk than was measured",
          .less = "the sensor stands {} lower above the desk than was measured",
          .parameters = {{"height_mm", "added to the sensor's height", 0.0, 1.0, -50.0, 50.0}},
          .citation = "Khoshelham & Elberink 2012, Sensors 12, 1437: exterior orientation in the error budget",
          .confounded = {"cup_bottom_height", "sensor_pitch"},
          .discriminated_by = "bare-desk views: the fitted desk lies lower",
          .apply = apply_sensor_height};
}

}  // namespace fathom::effects
