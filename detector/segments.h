// Segments on the desk: what stands together, seen from above. Rings of walls stay whole where only parts are seen.
#pragma once

#include <vector>

#include "detector/cloud.h"

namespace fathom {

struct SegmentSearch {
  double cell_m = 0.010;  ///< neighbours at 1.3 m are 5 mm apart along the desk, seen at 45°
  int gap_cells =
      2;  ///< the sides of mugs, seen at a grazing angle or in the projector's shadow, miss 15 mm, of pots 25
  double reach_m = 2.0;   ///< from below the camera; farther on, depths come in steps of 12 mm and more
  double low_m = 0.010;   ///< the desk itself reads up to 4 mm too high, with a noise of 2 mm at 1 m
  double high_m = 0.400;  ///< lamps and heads are not on the desk
  int points_min = 60;    ///< smaller ones are noise: a cup of 50 mm height has 300 points at 1.3 m
};

/// Groups of points [m, desk frame] in cells of the desk that touch, also by their corners, or have so many empty cells
/// between them. In the order of the points.
std::vector<Points> grid_segments(const Points& points, const SegmentSearch& search);

}  // namespace fathom
