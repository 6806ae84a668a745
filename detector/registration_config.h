// Parameters of the global registration that the paper compares with.
#pragma once

namespace fathom {

struct RegistrationConfig {
  double normal_radius_m = 0.020;   ///< neighbours of a normal; of 5, 10 and 20 mm the best on nine measured desks
  double feature_radius_m = 0.025;  ///< neighbours of a descriptor: as wide as a cup's radius
  int iterations = 1000;            ///< samples of correspondences that are tried
  double score_max_m = 0.010;       ///< mean distance from the template; as the paper's method's
};

}  // namespace fathom
