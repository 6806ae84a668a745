// The desk, fast: RANSAC on a draw of the points, least squares on all of them. Any pose of the camera.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "detector/plane.h"

namespace fathom {

struct DeskSearch {
  double threshold_m = 0.010;  ///< as the paper's; desks read up to 4 mm off a plane at 1.6 m, noise of 2 mm at 1 m
  double refine_m = 0.005;     ///< the last fit leaves out what stands higher: cups' bottoms are 3 to 10 mm high
  int draw = 4096;             ///< points that are looked at: a plane of 3 % has 120 of them
  int iterations_max = 1000;   ///< finds a plane that holds 17 % of what is left with 99 %
  int planes_max = 4;          ///< without a prior walls and floor may be larger than the desk
  double share_min = 0.03;     ///< of the points; less is no desk
  double share_of_largest_min = 0.1;  ///< without a prior; less is a box's face before a camera that hangs upside down
  double prior_angle_max_rad = 0.35;  ///< as the paper's method
  double prior_height_max_m = 0.15;
};

/// With a prior: of the planes that agree with it the one with the most points. Without: the largest among those that a
/// camera pitched between level and straight down stands above, if it is not small, else the largest of all (a camera
/// mounted on its side or upside down). Equal clouds give equal desks.
std::variant<PlaneFit, NoDesk> find_desk(const Points& points, const std::optional<DeskPrior>& prior,
                                         const DeskSearch& search);

}  // namespace fathom
