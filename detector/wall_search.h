// Where and how finely round walls are looked for.
#pragma once

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

}  // namespace fathom
