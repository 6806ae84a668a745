// Round upright walls in a segment: RANSAC finds circles in thin slabs of height, least squares fits a cone to each.
// Handles, neighbours and occluders lie off the circle and do not count.
#pragma once

#include <vector>

#include "detector/cloud.h"

namespace fathom {

struct WallSearch {
  double low_m = 0.020;         ///< below, a foot may be rounded and the bottom's points mix in
  double high_m = 0.170;        ///< the tallest cups' rims
  double slab_m = 0.008;        ///< a wall that leans 10° moves 1.4 mm in it
  double tolerance_m = 0.003;   ///< half a wall's thickness of 3 to 5 mm, plus noise of 1 to 2 mm
  double radius_min_m = 0.015;  ///< wider than what cups are: the wide ones get a reason, too
  double radius_max_m = 0.100;
  int hypotheses = 300;   ///< a cup beside two others holds a third of a slab: 11 of 300 draws are its own
  int slab_points = 400;  ///< drawn of each slab
  double arc_min = 0.30;  ///< share of the directions; a corner of a box reaches 0.36 and fails elsewhere
  int walls_max = 8;      ///< of one segment
  int rounds_max = 16;    ///< of looking for them; lids and corners take some in vain
};

/// The wall of a round vessel that stands upright: radius(z) = radius + lean · (z − kWallHeight).
struct RoundWall {
  Eigen::Vector2d center;  ///< [m] desk frame
  double radius_m;         ///< 45 mm above the desk, between the inner and the outer wall where both are seen
  double lean;             ///< change of the radius with the height; 0: upright, above 0: wider at the top
  double low_m;            ///< the lowest point on it
  double top_m;            ///< its rim
  double rms_m;            ///< of the distances from it
  double radius_sigma_m;   ///< standard deviations of the fit, with neighbours' errors alike:
  double center_sigma_m;   ///< short arcs make them large
  double arc_share;        ///< of 32 directions that hold points
  int points;

  double radius_at(double height_m) const;
  double distance_of(const Eigen::Vector3f& point) const;  ///< from the axis
};

inline constexpr double kWallHeight = 0.045;  ///< [m] of a wall's radius and centre: the middle of the paper's band

/// The best first; each takes the points within it away before the next is looked for.
std::vector<RoundWall> find_round_walls(const Points& segment, const WallSearch& search);

}  // namespace fathom
