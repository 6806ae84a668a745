// A capture's folder as the page's data.
#pragma once

#include <filesystem>

#include "core/json.h"

namespace fathom {

/// Frame number `frame` of the capture in `folder`: sensor, meshes, and every pixel with its rays. Throws Error when
/// the folder holds no complete capture, when it has no such frame, when its depths are damaged or were moved to the
/// colour camera's view.
Json capture_scene(const std::filesystem::path& folder, int frame);

}  // namespace fathom
