// What of a scene is allowed and yet hardly meant.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/setup.h"

namespace fathom {

/// A sentence for each: lengths that are so small that they may have been given in metres, "/cups/0/fill_mm: 0.04 mm;
/// …"; cups of which no part is in the image.
std::vector<std::string> scene_doubts(const Setup& setup);

}  // namespace fathom
