// What of a scene is allowed and yet hardly meant.
#pragma once

#include <string>
#include <vector>

#include "core/json_fwd.h"

namespace fathom {

/// Lengths of a scene that are so small that they may have been given in metres, a sentence each:
/// "/cups/0/fill_mm: 0.04 mm; …".
std::vector<std::string> scene_doubts(const Json& scene);

}  // namespace fathom
