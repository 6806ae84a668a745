// JSON before it is parsed.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace fathom {

/// To be asked of JSON before any parser is given it. Throws Error when `text` is nested too deep for code that takes
/// it apart by recursion, or when its values, of `bytes_per_value` at most, would take more memory than the
/// InputPolicy allows. Whether it is JSON does not matter.
void require_modest_json(std::string_view text, const std::string& file, std::size_t bytes_per_value);

}  // namespace fathom
