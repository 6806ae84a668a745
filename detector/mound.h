// What is heaped in a vessel: liquids are level, powders and grains stand up from the wall to the axis.
#pragma once

#include "detector/surface.h"

namespace fathom {

struct MoundSlope {
  double slope_rad;  ///< how steeply what is seen inside rises towards the axis
  double sigma_rad;  ///< when neighbours err alike; large where only one side is seen
};

/// By least squares, beside a lean to any side, over the points `inside` that lie about the surface.
MoundSlope mound_slope(const Points& inside, const RoundWall& wall, const LevelSurface& surface,
                       const SurfaceSettings& settings);

}  // namespace fathom
