// A frame's cloud as the estimators take it, and what in it cannot be what the notes say.
#pragma once

#include <vector>

#include "detector/cloud.h"
#include "diagnosis/measurement/frame_estimates.h"
#include "diagnosis/measurement/frames.h"

namespace fathom {

/// The measured points; of a cloud without rows each weighs as much of the image as it stands for.
std::vector<SensedPoint> sensed_points(const Cloud& cloud, const LaboratoryRig& rig);

/// Where the notes say that the cup stands, and how full.
FrameView view_of(const FrameRecord& frame);

/// Whether a fitted plane may be the desk that the rig stands on: within what the detector allows one.
bool is_near(const Plane& desk, const LaboratoryRig& rig);

/// Whether the desk is seen inside a cup whose bottom should stand clear of it.
bool shows_desk(const FrameEstimates& estimates, const LaboratoryRig& rig);

}  // namespace fathom
