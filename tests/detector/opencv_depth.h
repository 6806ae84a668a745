// Depth images that OpenCV wrote as XML, for clouds measured by others.
#pragma once

#include <filesystem>

#include "detector/cloud.h"

namespace fathom {

/// Reads a gzipped file with one matrix of depths [m]; the principal point is the image's middle. Throws Error when it
/// is something else.
Cloud read_opencv_depth(const std::filesystem::path& path, double focal_px);

}  // namespace fathom
