// What is seen level inside a vessel: its bottom, its raised bottom or a liquid's surface.
#pragma once

#include <optional>

#include "detector/round_wall.h"
#include "detector/vessel_rays.h"

namespace fathom {

struct SurfaceSettings {
  double margin_m = 0.010;  ///< from the wall, as the paper's: half of the window that is matched as one, 6 mm at 0.8 m
  double level_m =
      0.004;  ///< points so near to the plane about the commonest height belong to the surface: twice the noise at 1 m
  double share_min = 0.5;       ///< of the points inside that belong to it; a wall's points spread over all heights
  double tilt_max_rad = 0.087;  ///< 5°: floors of pots and bowls lean 1 to 3°, a mound of sugar up to 35°
  double slope_max_rad = 0.6;   ///< 35°, as steep as a mound stands; steeper is a wall
  double roughness_max = 2.0;   ///< SD over the noise of single depths: floors of pots show 0.9 to 1.1
  int points_min = 40;  ///< half of a window of 9 × 9 pixels that is matched as one: fewer are the wall's neighbours
};

/// A plane, level or a bit tilted, in what is seen inside. Desk frame.
struct LevelSurface {
  Eigen::Vector3d middle;  ///< mean of its points
  double sd_m;             ///< of the points from it
  double tilt_rad;         ///< of the plane through them
  double tilt_sigma_rad;
  double range_m;  ///< of its middle from the camera
  int points;
};

/// Nothing when nothing level is seen.
std::optional<LevelSurface> find_surface(const Points& inside, const RoundWall& wall, double camera_height_m,
                                         const SurfaceSettings& settings);

/// What is heaped: liquids are level, powders and grains stand up from the wall to the axis.
struct MoundSlope {
  double slope_rad;  ///< how steeply what is seen inside rises towards the axis
  double sigma_rad;  ///< when neighbours err alike; large where only one side is seen
};

/// By least squares, beside a lean to any side, over the points `inside` that lie about the surface.
MoundSlope mound_slope(const Points& inside, const RoundWall& wall, const LevelSurface& surface,
                       const SurfaceSettings& settings);

}  // namespace fathom
