// A detection's folder as the page's data.
#pragma once

#include <filesystem>

#include "core/json.h"

namespace fathom {

/// What was found in cloud number `number`, and its points in the desk's frame, each with what it belongs to. Throws
/// Error when the folder holds no detection or not that cloud, and when its files are damaged.
Json detection_scene(const std::filesystem::path& folder, int number);

}  // namespace fathom
