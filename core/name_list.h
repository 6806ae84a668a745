// Many names in a sentence.
#pragma once

#include <span>
#include <string>

namespace fathom {

/// "1, 2, 3, 4, 5 and 12 more"
std::string name_list(std::span<const std::string> names);

}  // namespace fathom
