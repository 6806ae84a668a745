#include <cmath>

#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

void apply_reference_residue(Setup& setup, const EffectSetting& setting) {
  double& residue_px = setup.rig.sensor.unit.residue_px;
  residue_px = std::hypot(residue_px, setting.values[0]);
}

}  // namespace

Effect reference_residue() {
  return {
      .id = "reference_residue",
      .family = "sensor",
      .sentence = "The sensor remembers its reference plane displaced, by another amount in every part of the image.",
      .parameters = {{"sd_px", "standard deviation over the image, of disparity", 0.0, 0.05, 0.0, 1.0}},
      .citation = "what nine measured desks have in common beside their planes: 0.68 steps of 1/8 px over 70 px",
      .confounded = {"radial_distortion"},
      .discriminated_by = "the residual of the bare desk by image region",
      .apply = apply_reference_residue};
}

}  // namespace fathom::effects
