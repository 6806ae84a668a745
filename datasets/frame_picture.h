// A frame of a data set as a picture for people.
#pragma once

#include "core/image_file.h"
#include "datasets/labels.h"

namespace fathom {

/// Half as large as the depth image: measured depth in grey, near is bright; cups tinted green, other things blue,
/// liquids that are seen through cyan and surfaces of turbid ones orange.
Image<Rgb> frame_picture(const Frame& frame, const std::vector<InstanceLabel>& labels);

}  // namespace fathom
