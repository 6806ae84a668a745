// A depth image for people.
#pragma once

#include "core/image_file.h"

namespace fathom {

/// Grey, near is bright; black where there is no depth (0 or NaN).
Image<Rgb> depth_picture(const Image<float>& depth_m);

}  // namespace fathom
