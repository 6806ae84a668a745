// The paper's sensor and cup as a laboratory writes them down, with water and an opaque liquid, and shots of them.
#pragma once

#include "core/json.h"
#include "core/units.h"
#include "diagnosis/predict/nominal_model.h"
#include "sim/effects/effects_json.h"

namespace fathom {

inline LaboratoryRig paper_laboratory() {
  LaboratoryRig rig;
  rig.sensor_model = "xtion_pro_live";
  rig.height_m = 0.650;
  rig.pitch_rad = radians_from_deg(58.4);
  rig.focal_px = 1200.0 / (2 * 1.052);
  rig.liquids = {{"water", Json("water")}, {"milk", Json{{"index", 1.336}, {"scattering_per_mm", 1000.0}}}};
  return rig;
}

/// Of a cup there with a liquid of the laboratory, or "empty".
inline Factors paper_shot(std::string liquid, double fill_mm, double distance_mm, double lateral_mm = 0.0) {
  Factors factors;
  factors.liquid = std::move(liquid);
  factors.fill_mm = fill_mm;
  factors.distance_mm = distance_mm;
  factors.lateral_mm = lateral_mm;
  return factors;
}

/// One shot in it; depths are not quantised, because without noise steps are no steps in the mean.
inline Setup paper_setup(const Factors& factors, Json effects) {
  NominalModel model = nominal_model(paper_laboratory(), "rig.json");
  model.rig.sensor.law.quantized = false;
  Setup setup = setup_of(model, factors);
  setup.effects = std::move(effects);
  return with_effects(std::move(setup));
}

}  // namespace fathom
