// What the infrared image says about a cup's content. Light spreads in what scatters: its dots are washed out and often
// not matched at all. Clear liquids keep the dots of the bottom below, but dim them: light is lost at the surface, in
// the liquid, and spreads by n² where it comes out.
#pragma once

#include <Eigen/Geometry>

#include "detector/fill.h"
#include "detector/pinhole.h"
#include "detector/round_wall.h"

namespace fathom {

struct ContentSignSettings {
  double margin_m = 0.010;  ///< from the wall and from the rim, as of the surface
  int pixels_min = 40;      ///< half a window of 9 × 9 that is matched as one
  /// The dots' contrast (SD/mean of the infrared image) relative to the desk's: 0.75 on a dry bottom and under water,
  /// where walls light each other, 0.25 to 0.35 on juices and milk tea; measured on milky plastic 0.2.
  double contrast_max = 0.5;
  double brightness_min = 0.3;  ///< relative to the desk's; darker places are in the projector's shadow
  double matched_max = 0.5;     ///< share of the pixels that measured something; 1 on bottoms, 0 to 0.34 on juices
  double ratio = 20.0;          ///< of likelihoods, when dots are washed out: one in twenty is something else
  double level_step_m = 0.005;  ///< levels that are tried where no surface was measured
};

/// `level_m`: height of the surface that was measured, or nothing. Sharp dots speak for nothing, as thick milk shows
/// them too. Needs intensities; without them nothing is said.
ContentSigns content_signs(const Cloud& cloud, const Pinhole& pinhole, const Eigen::Isometry3d& desk_from_camera,
                           const RoundWall& wall, std::optional<double> level_m, const ContentSignSettings& settings);

}  // namespace fathom
