// Clouds from files: PCD (ascii, binary, binary_compressed) and PLY, with any fields beside x, y, z.
#pragma once

#include <filesystem>

#include "detector/cloud.h"

namespace fathom {

/// Metres are taken for granted. A cloud that lies wholly at negative z is in the other common camera frame (y up, z
/// backward, as in OpenGL) and is turned. A VIEWPOINT is ignored: files in circulation disagree with their own. Points
/// with a coordinate that is not finite, and points at (0, 0, 0) (how some writers say "nothing measured"), become NaN.
/// Throws Error when the file is missing, malformed, truncated or has no x, y, z.
Cloud read_cloud(const std::filesystem::path& path);

}  // namespace fathom
