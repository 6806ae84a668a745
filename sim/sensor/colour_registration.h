// Depth registered to the colour camera: what most recorded clouds of these sensors are.
#pragma once

#include "core/image.h"

namespace fathom {

/// The colour camera stands beside the infrared camera, towards the projector, with the same axes.
inline constexpr double kColourCamera = 0.025;  ///< [m]

/// Of the colour camera, as drivers that make clouds take it; OpenNI2 takes the depth image's.
inline constexpr double kColourFocalPx = 525.0;

/// Each depth [m] of an image of focal length `focal_px` moves to where a colour camera of `colour_focal_px` and the
/// same size sees its point; the nearest wins, and what no point meets is a hole, 0. Depths stay as they are, as the
/// device leaves them.
Image<float> registered_to_colour(const Image<float>& depth, double focal_px, double colour_focal_px);

}  // namespace fathom
