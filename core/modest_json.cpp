#include "core/modest_json.h"

#include <fmt/format.h>

#include <cstdint>
#include <vector>

#include "core/error.h"
#include "core/input_policy.h"

namespace fathom {

void require_modest_json(std::string_view text, const std::string& file, JsonMemory memory) {
  constexpr std::size_t kDeepest = 100;
  constexpr std::size_t kMostSteps = 200'000'000;  // seconds: every key is compared with those before it in its object
  std::uint64_t values = 1, steps = 0;
  std::vector<std::size_t> members;  // of the lists and objects that are open
  for (std::size_t i = 0; i < text.size(); ++i) switch (text[i]) {
      case '"':  // to the end of the string
        for (++i; i < text.size() && text[i] != '"'; ++i)
          if (text[i] == '\\') ++i;
        break;
      case '[':
      case '{':
        members.push_back(0);
        if (members.size() > kDeepest) throw Error(file, fmt::format("is nested more than {} deep", kDeepest));
        ++values;
        break;
      case ':':
        if (!members.empty() && (steps += ++members.back()) > kMostSteps)
          throw Error(file, "has objects of so many keys that reading them would take minutes");
        [[fallthrough]];
      case ',':
        ++values;
        break;
      case ']':
      case '}':
        if (!members.empty()) members.pop_back();
        break;
      default:
        break;
    }
  require_within_limit(file, "", bytes_of({values, memory.per_value}) + bytes_of({text.size(), memory.per_byte}),
                       "values");
}

}  // namespace fathom
