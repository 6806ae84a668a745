// Round upright walls in a segment: circles in thin slabs of height, and a cone through the points about each.
// Handles, neighbours and occluders lie off the circle and do not count.
#pragma once

#include <vector>

#include "detector/cloud.h"
#include "detector/cone.h"
#include "detector/wall_search.h"

namespace fathom {

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

/// The best first; each takes the points within it away before the next is looked for.
std::vector<RoundWall> find_round_walls(const Points& segment, const WallSearch& search);

}  // namespace fathom
