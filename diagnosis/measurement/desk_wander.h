// Whether the whole desk moves from frame to frame, beyond what the noise of its parts makes.
#pragma once

#include "diagnosis/measurement/rig.h"
#include "diagnosis/statistics/evidence.h"

namespace fathom {

/// "desk_wander_mm", one for each session with enough repeats (three of a single one): the root of the variance by
/// which the desk's height differs between trials, less that which follows from how the thirds of the image scatter;
/// negative where that is more. Bare-desk observations, at the session's start.
std::vector<Observation> desk_wander(const std::vector<Observation>& observations, const LaboratoryRig& rig);

}  // namespace fathom
