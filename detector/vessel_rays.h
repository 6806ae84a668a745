// What the lines of sight say about a round wall: a vessel stops those that meet its wall, and swallows those that pass
// its rim unless it is closed.
#pragma once

#include "detector/cloud.h"
#include "detector/round_wall.h"

namespace fathom {

struct VesselRaysSettings {
  double tolerance_m = 0.006;  ///< of a wall's place: its thickness and twice the noise
  double margin_m = 0.008;     ///< the rim's own width and the pixels that mix it with what lies behind
  /// Lids of cans lie 3 to 6 mm below their rims, feet of inverted mugs as deep; noise adds 2 mm. A cup that is filled
  /// higher than this looks closed.
  double lid_m = 0.012;
};

/// Numbers of points, each the end of a line of sight.
struct VesselRays {
  int wall = 0;    ///< end on the outside
  int lid = 0;     ///< end within the rim and not deeper than a lid, or higher
  int beyond = 0;  ///< would have met the wall, or passed the rim, and end behind the vessel
  Points inside;   ///< end deeper inside: on the far wall, the bottom or what stands in it

  double lid_share() const;     ///< of the lines that reach the opening, which is 0 for a cup
  double beyond_share() const;  ///< of all that meet the vessel, which is 0 for an opaque one
};

/// `points` [m, desk frame] are the whole scene's, `camera_height_m` is that of the origin of all lines of sight.
VesselRays trace_vessel(const Points& points, double camera_height_m, const RoundWall& wall,
                        const VesselRaysSettings& settings);

}  // namespace fathom
