// The points of a PLY file.
#pragma once

#include <string>
#include <string_view>

#include "detector/cloud.h"

namespace fathom {

/// x, y, z and intensity of its vertices, whatever else stands beside them or in other elements, in any order, lists
/// included. The cloud is organised where the header or a camera's viewport says so and it fits. Throws Error where the
/// file is malformed or cut short.
Cloud read_ply(const std::string& file, std::string_view content);

}  // namespace fathom
