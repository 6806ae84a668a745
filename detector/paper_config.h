// Every parameter of the paper's method. Where the paper prints a number, it is the default.
#pragma once

#include "detector/cup_gates.h"
#include "detector/icp.h"
#include "detector/liquid.h"
#include "detector/plane.h"

namespace fathom {

struct PaperConfig {
  PlaneSearch plane;
  double height_max_m = 0.100;  ///< points higher above the desk belong to no cup (the paper's are at most 87 mm high)
  double cluster_distance_m = 0.040;
  int cluster_points_min = 100;  ///< smaller segments are noise; a cup at 1 m has some 2000 points
  CupGates cup;
  IcpSettings icp;
  InteriorSettings interior;
};

}  // namespace fathom
