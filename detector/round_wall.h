// Round upright walls in a segment: circles in thin slabs of height, and a cone through the points about each.
// Handles, neighbours and occluders lie off the circle and do not count.
#pragma once

#include <vector>

#include "detector/cloud.h"
#include "detector/cone.h"
#include "detector/slab_circle.h"

namespace fathom {

/// The wall of a round vessel that stands upright.
struct RoundWall : WallCone {
  double low_m;           ///< the lowest point on it
  double top_m;           ///< its rim
  double rms_m;           ///< of the distances from it
  double radius_sigma_m;  ///< standard deviation of the fit, with neighbours' errors alike; short arcs make it large
  double arc_share;       ///< of 32 directions that hold points
  int points;

  double distance_of(const Eigen::Vector3f& point) const;  ///< from the axis
};

/// The best first; each takes the points within it away before the next is looked for.
std::vector<RoundWall> find_round_walls(const Points& segment, const WallSearch& search);

}  // namespace fathom
