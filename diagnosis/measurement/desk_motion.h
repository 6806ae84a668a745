// Whether the desk moves from frame to frame beyond what the noise of its parts makes: as a whole, or in waves that run
// along the rows.
#pragma once

#include "diagnosis/measurement/laboratory_rig.h"
#include "diagnosis/statistics/evidence.h"

namespace fathom {

/// Bare-desk observations, at the session's start; four for each session with enough repeats, or for each part of a
/// single one, three at most, of four placements at least. "desk_wander_mm": the root of the variance by which the
/// desk's height differs between trials, less that which follows from how the thirds of the image scatter; uncertain by
/// what waves may make of it. "desk_waves_px": the same of the mean disparity of 40 rows, less that of as many pixels
/// in columns. "desk_pitch_motion_deg", "desk_roll_motion_deg": as the first, of the camera's pitch and roll above the
/// desk: of a sensor that trembles. Negative where that is more.
std::vector<Observation> desk_motion(const std::vector<Observation>& observations, const LaboratoryRig& rig);

}  // namespace fathom
