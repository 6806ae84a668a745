// Media from JSON: a name from scenes/media, that name with a temperature or a dilution, or a description; and the
// walls of clear cups, from scenes/walls.
#pragma once

#include <vector>

#include "core/json.h"
#include "core/key_table.h"
#include "sim/optics/medium.h"

namespace fathom {

/// Throws Error naming file, path and what is allowed.
Medium medium_from_json(const JsonReader& json);
/// A name from scenes/walls or a description.
Medium wall_from_json(const JsonReader& json);
/// The objects that say a medium.
std::vector<KeyTable> medium_key_tables();

}  // namespace fathom
