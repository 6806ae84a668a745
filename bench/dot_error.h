// How good an image of a few dots is, on a desk and on the bottom under water, whoever made it.
#pragma once

#include "tests/sensor/sparse_dots.h"

namespace fathom {

struct DotError {
  int dots = 0;            ///< on the bottom
  double place_ir_px = 0;  ///< root mean square distance from the exact centre, of the dots on the bottom
  double brightness = 0;   ///< of the bottom's dots beside the desk's, 1 = exact
  double rmse = 0;         ///< over the pixels of the bottom's dots, relative to their root mean square, at best scale
};

/// `image` has the size of the dots' infrared image and any unit. A scale of its own is taken off `rmse`, so that it
/// tells of noise and blur, and `brightness` alone of too much or too little light.
DotError dot_error(const SparseDots& dots, const Image<float>& image);

}  // namespace fathom
