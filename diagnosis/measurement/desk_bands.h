// Whether rows of the image move apart from frame to frame, as a sensor that shakes while they are exposed makes them.
#pragma once

#include <span>

#include "diagnosis/measurement/frame_estimates.h"

namespace fathom {

/// By how much the mean disparities of bands of 40 rows and of 40 columns scatter between trials once each frame's
/// plane is taken off [px]: roots of variances, both as of bands of 25,600 pixels. Noise of no direction makes them
/// alike.
struct BandScatter {
  double rows_px = 0.0, columns_px = 0.0;
};

/// Of the trials of one placement; nothing of fewer than two, or where too little of the desk is seen in any of them.
std::optional<BandScatter> scatter_of(std::span<const DeskBands> trials);

}  // namespace fathom
