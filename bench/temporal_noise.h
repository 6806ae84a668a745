// What changes from frame to frame of a still scene.
#pragma once

#include "sim/sensor/capture.h"

namespace fathom {

struct TemporalNoise {
  double median_mm, mean_mm;  ///< of the deviations of those pixels' depths that half of the frames have
  double valid;               ///< share of pixels with a depth, over all frames, inside the border
};

/// Of sixteen frames.
TemporalNoise temporal_noise(Camera& camera);

}  // namespace fathom
