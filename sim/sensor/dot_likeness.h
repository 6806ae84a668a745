// How well a disparity explains the few dots around one pixel.
#pragma once

#include "core/image.h"
#include "sim/scene/rig.h"
#include "sim/sensor/reference.h"

namespace fathom {

/// The square that counts as the pixel's own.
inline constexpr int kDotColumns = 8;  ///< infrared pixels
inline constexpr int kDotRows = 3;     ///< row pairs

struct Likeness {
  float contrast = 0.0f;     ///< Σ (seen − its mean)² [DN²]
  float correlation = 0.0f;  ///< of what is seen and what the disparity predicts, −1 … 1
};

/// `disparity` relative to the reference plane [px]; all zero where the reference does not reach that far.
Likeness dot_likeness(const SensorModel& sensor, const SplitColumns<float>& paired, const Reference& reference, int x,
                      int y, float disparity);

}  // namespace fathom
