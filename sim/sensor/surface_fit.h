// Straight surfaces through the disparities around a pixel.
#pragma once

#include "core/image.h"

namespace fathom {

/// Disparity of a straight surface at a pixel [px], and its slopes [px/px].
struct LocalSurface {
  float disparity, slope_x, slope_y;
};

/// Disparities on a grid around a pixel, NaN where there is none to be used.
struct Neighbours {
  static constexpr int kAlong = 7, kStride = 3;  ///< grid points, and their distance [px]
  static constexpr int kReach = kAlong / 2 * kStride;

  float disparity[kAlong][8];  ///< the last column is NaN
};

/// From an image that is framed by Neighbours::kReach pixels.
Neighbours neighbours_of(const Image<float>& framed, int x, int y);

/// Fits a surface to those neighbours that lie on it; leaves it as it is where they are too few.
void fit(const Neighbours& neighbours, LocalSurface& surface);

}  // namespace fathom
