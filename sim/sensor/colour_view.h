// Depth registered to the colour camera: what most recorded clouds of these sensors are.
#pragma once

#include "core/image.h"

namespace fathom {

/// Of the colour camera, as drivers take it.
inline constexpr double kColourFocalPx = 525.0;

/// What the colour camera, 25 mm to the right, has in each pixel of a depth image of focal length `focal_px`: the
/// nearest. Depths stay as they are, as the device leaves them.
Image<float> in_colour_view(const Image<float>& depth, double focal_px);

}  // namespace fathom
