// How good a disparity image is.
#pragma once

#include "bench/stereo_pair.h"

namespace fathom {

struct MatchError {
  double valid = 0;      ///< share of the lit pixels that have a disparity
  double median_px = 0;  ///< of |e| over the valid pixels
  double rms_px = 0;     ///< of the inliers, |e| < 1 px
  double outliers = 0;   ///< share of the valid pixels with |e| ≥ 1 px
};

/// Compares disparities relative to the reference plane [px], NaN = invalid, with the truth. Columns whose search range
/// leaves OpenCV's images, and rows whose window does, are left out for every matcher.
MatchError match_error(const StereoPair& pair, const Image<float>& disparity_px);

}  // namespace fathom
