// The paper's sensor and cup as a laboratory writes them down, with water and an opaque liquid.
#pragma once

#include "core/units.h"
#include "diagnosis/predict/nominal_model.h"

namespace fathom {

inline LaboratoryRig paper_laboratory() {
  LaboratoryRig rig;
  rig.sensor_model = "xtion_pro_live";
  rig.height_m = 0.650;
  rig.pitch_rad = radians_from_deg(58.4);
  rig.focal_px = 1200.0 / (2 * 1.052);
  rig.liquids = {{"water", "water"}, {"milk", {{"index", 1.336}, {"scattering_per_mm", 1000.0}}}};
  return rig;
}

}  // namespace fathom
