// What to measure next, as a file that `fathom campaign` runs.
#pragma once

#include "diagnosis/predict/designs.h"

namespace fathom {

/// The plan at the laboratory's rig, without any effect; photometric.
Json campaign_of(const MeasurementPlan& plan, const LaboratoryRig& rig);

}  // namespace fathom
