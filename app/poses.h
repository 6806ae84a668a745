// Where the cameras of several views of one desk stood.
#pragma once

#include <filesystem>
#include <vector>

#include "core/pose.h"

namespace fathom {

/// {"world_from_camera": [[[r, r, r, x], [r, r, r, y], [r, r, r, z]], …]}: for each of `count` clouds the rows of its
/// rotation and position [m]. Throws Error when a rotation is none, or their number differs.
std::vector<Pose> read_poses(const std::filesystem::path& path, std::size_t count);

}  // namespace fathom
