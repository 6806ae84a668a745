// What a laboratory would write down about a simulated sensor and cup.
#pragma once

#include "diagnosis/measurement/laboratory_rig.h"
#include "sim/scene/rig.h"
#include "sim/scene/scene.h"

namespace fathom {

/// The rig without any liquids. A measurement directory names its sensor's model and cannot say that the sensor looks
/// aside: throws Error, as coming from `file`, when the rig has no model or a yaw.
LaboratoryRig nominal_rig(const Rig& rig, const CupShape& cup, const std::string& file);

}  // namespace fathom
