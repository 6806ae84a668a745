#include "core/modest_json.h"

#include <fmt/format.h>

#include <cstdint>

#include "core/error.h"
#include "core/input_policy.h"

namespace fathom {

void require_modest_json(std::string_view text, const std::string& file, JsonMemory memory) {
  constexpr int kDeepest = 100;
  std::uint64_t values = 1;
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) switch (text[i]) {
      case '"':  // to the end of the string
        for (++i; i < text.size() && text[i] != '"'; ++i)
          if (text[i] == '\\') ++i;
        break;
      case '[':
      case '{':
        if (++depth > kDeepest) throw Error(file, fmt::format("is nested more than {} deep", kDeepest));
        [[fallthrough]];
      case ',':
      case ':':
        ++values;
        break;
      case ']':
      case '}':
        --depth;
        break;
      default:
        break;
    }
  require_within_limit(file, "", bytes_of({values, memory.per_value}) + bytes_of({text.size(), memory.per_byte}),
                       "values");
}

}  // namespace fathom
