// What a sensor can see of a cup at a place, by the rig alone: geometry, no cloud.
#pragma once

#include <Eigen/Core>

#include "diagnosis/measurement/rig.h"

namespace fathom {

/// `cup` [m]: (lateral, distance) of its axis. Of its foot and its rim the share that is in the image.
double share_in_image(const Eigen::Vector2d& cup, const LaboratoryRig& rig);

/// Pixels in which camera and projector see what is looked at in the cup. A clear liquid lifts the bottom by a third of
/// its depth; what is turbid is seen from farther still.
double pixels_in_sight(const Eigen::Vector2d& cup, double fill, const LaboratoryRig& rig);

/// How many mm of height a unit's own bias makes there.
double bias_mm(const Eigen::Vector2d& cup, const LaboratoryRig& rig);

}  // namespace fathom
