// A capture as a picture for people.
#pragma once

#include "core/image_file.h"
#include "sim/sensor/capture.h"

namespace fathom {

/// Four panels, each as large as the depth image: infrared (or the noise-free brightness), measured depth, true
/// apparent depth, measured minus true (blue −5 mm, white 0, red +5 mm; black: no depth, grey: none expected).
Image<Rgb> preview(const Frame& frame, const Image<TruePixel>& truth);

}  // namespace fathom
