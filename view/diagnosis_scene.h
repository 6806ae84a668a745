// A diagnosis' folder as the page's data.
#pragma once

#include <filesystem>

#include "core/json.h"

namespace fathom {

/// Every condition with the heights in its cup, measured and as the model has them before and after what was found, and
/// the points of one of its clouds where shots.json has one. Throws Error when the folder holds no diagnosis of
/// heights, and when its files are damaged.
Json diagnosis_scene(const std::filesystem::path& folder);

}  // namespace fathom
