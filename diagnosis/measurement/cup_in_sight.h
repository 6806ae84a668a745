// What a sensor can see of a cup at a place, by the rig alone: geometry, no cloud.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>

#include "diagnosis/measurement/laboratory_rig.h"

namespace fathom {

/// `cup` [m]: (lateral, distance) of its axis. The box about its foot and its rim [px] in an image of 640 x 480, which
/// may reach beyond it; empty where some of the cup is behind the camera.
Eigen::AlignedBox2d cup_in_image(const Eigen::Vector2d& cup, const LaboratoryRig& rig);

/// Of its foot and its rim the share that is in the image.
double share_in_image(const Eigen::Vector2d& cup, const LaboratoryRig& rig);

/// Whether the cup is in the image, and not far nearer than where the sensor looks. A steep sensor sees the desk beside
/// its own foot, where a distance is most often one in cm.
bool is_in_sight(const Eigen::Vector2d& cup, const LaboratoryRig& rig);
/// What a distance_mm must be for that, in words that follow "must be".
std::string words_in_sight(const Eigen::Vector2d& cup, const LaboratoryRig& rig);

/// Pixels in which camera and projector see what seems to lie so high above the desk in the cup, and farther than
/// windows reach from its wall.
double pixels_in_sight(const Eigen::Vector2d& cup, double height, const LaboratoryRig& rig);

/// Rms of an uncalibrated unit's bias of disparity: 0.097 px on measured desks, a plane taken off and noise smoothed
/// over 8 px (docs/calibrate.md).
inline constexpr double kBias_px = 0.1;

/// How many mm higher the bottom of a cup there reads when disparities are 1 px too large. The fitted desk hardly
/// moves: a bias that reaches as far as a cup does is no plane.
double height_per_px_mm(const Eigen::Vector2d& cup, const LaboratoryRig& rig);

}  // namespace fathom
