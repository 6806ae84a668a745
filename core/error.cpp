#include "core/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fathom {

Error::Error(std::string_view file, std::string_view what) : std::runtime_error(fmt::format("{}: {}", file, what)) {}

Error::Error(std::string_view file, std::string_view where, std::string_view what)
    : std::runtime_error(fmt::format("{}: {}: {}", file, where, what)) {}

std::string unknown_name(std::string_view kind, std::string_view name, std::span<const std::string> choices) {
  return fmt::format("unknown {} '{}', choose from {}", kind, name, fmt::join(choices, ", "));
}

}  // namespace fathom
