// Depth and memory limits of JSON, checked before it is parsed.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace fathom {

/// What a parser takes of memory at most.
struct JsonMemory {
  std::size_t per_value;  ///< [bytes]
  std::size_t per_byte;   ///< of the text, which may be one long string: copies that there are at once, the text's too
};

/// To be asked of JSON before any parser is given it. Throws Error when `text` is nested too deep for code that takes
/// it apart by recursion, has an object of more keys than are found one by one in seconds, or when it would take more
/// memory than the InputPolicy allows. Whether it is JSON does not matter.
void require_modest_json(std::string_view text, const std::string& file, JsonMemory memory);

}  // namespace fathom
