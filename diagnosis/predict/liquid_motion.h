// Whether what is seen through a clear liquid moves from shot to shot beyond what else is seen in cups.
#pragma once

#include <vector>

#include "diagnosis/statistics/evidence.h"

namespace fathom {

/// One "liquid_motion_mm" for each fill of a clear liquid, as of the middle of its places: the root of the variance by
/// which a region's height differs between shots of the same condition, each pour about its own mean, less that of what
/// is not seen through a clear liquid; uncertain by most of that. `sees_through`: which observations are of one, for
/// the model. Nothing where too little was repeated.
std::vector<Observation> liquid_motion(const std::vector<Observation>& observations,
                                       const std::vector<bool>& sees_through);

}  // namespace fathom
