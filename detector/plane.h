// The desk: repeated RANSAC finds planes, the one closest to where the desk should be is taken. Paper, section V-A.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "detector/cloud.h"

namespace fathom {

/// Points p with normal · p + offset = 0.
struct Plane {
  Eigen::Vector3d normal;  ///< unit length
  double offset;           ///< [m] signed distance of the origin, on the normal's side where positive

  double height_of(const Eigen::Vector3d& point) const { return normal.dot(point) + offset; }
};

/// How the sensor is mounted over the desk.
struct DeskPrior {
  double height_m;        ///< of the camera above the desk
  double pitch_rad;       ///< 0: looking horizontally, π/2: straight down
  double roll_rad = 0.0;  ///< about the line of sight, positive when the camera's right side is lowered
};

Plane plane_from(const DeskPrior& prior);

/// Pitch of a camera above a plane whose normal points up.
double pitch_above(const Plane& plane);

/// Its roll, as in DeskPrior.
double roll_above(const Plane& plane);

/// From the camera frame to the desk's: origin below the camera on the desk, z up, y the horizontal line of sight (the
/// direction of the image's top when the camera looks straight down), x to the camera's right.
Eigen::Isometry3d desk_from_camera(const Plane& desk);

struct PlaneFit {
  Plane plane;         ///< least squares; the normal is on the camera's side
  int inliers = 0;     ///< points within the threshold
  double rms_m = 0.0;  ///< of the inliers' distances
};

struct NoDesk {
  std::string why;
};

struct PlaneSearch {
  double threshold_m = 0.010;  ///< the paper's outlier rejection
  int planes_max = 6;  ///< RANSAC is repeated on what is left over, so often at most (the paper gives no number) …
  double share_min = 0.03;  ///< … and while a plane holds at least this share of the measured points
  int draw = 8192;          ///< points that RANSAC looks at: a plane of 3 % has 245 of them; the fit takes all
  int iterations_max = 1000;
  double prior_angle_max_rad = 0.35;  ///< planes tilted more than this (20°) against the prior are no desk
  double prior_height_max_m = 0.15;   ///< nor are planes that put the camera higher or lower by more than this
};

/// Largest first, about: in the order RANSAC finds them. The seed is fixed: equal points give equal planes.
std::vector<PlaneFit> find_planes(const Points& points, const PlaneSearch& search);

/// The plane closest to the prior, by the distance between the feet of the camera's perpendiculars. Without a prior:
/// the one with the most inliers among those that a camera pitched between level and straight down can stand above (its
/// normal within 60° of the camera's up-and-backward diagonal (0, −1, −1)). Nothing when there is no such plane.
std::optional<PlaneFit> choose_desk(const std::vector<PlaneFit>& planes, const std::optional<DeskPrior>& prior,
                                    const PlaneSearch& search);

}  // namespace fathom
