#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_radial_distortion(Setup& setup, const EffectSetting& setting) {
  setup.rig.sensor.optics.camera_k1 += setting.values[0];
}

}  // namespace

Effect radial_distortion() {
  return {.id = "radial_distortion",
          .family = "sensor",
          .sentence = "The camera's lens bends straight lines, and the device does not know.",
          .parameters = {{"k1", "of Brown's model, over the focal length", 0.0, 0.01, -0.15, 0.15}},
          .citation = "Brown 1966, Photogrammetric Engineering 32, 444",
          .confounded = {"principal_point"},
          .discriminated_by = "the residual of the bare desk by image region",
          .apply = apply_radial_distortion};
}

}  // namespace fathom::effects
