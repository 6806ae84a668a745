#include "core/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fathom {
namespace {

/// what() ends at a NUL, which a file's names may hold: the message would lose what is wrong.
std::string without_nul(std::string_view message) {
  std::string text;
  for (const char c : message)
    if (c == '\0')
      text += "\\u0000";
    else
      text += c;
  return text;
}

}  // namespace

Error::Error(const std::string& message) : std::runtime_error(without_nul(message)) {}

Error::Error(std::string_view file, std::string_view what) : Error(fmt::format("{}: {}", file, what)) {}

Error::Error(std::string_view file, std::string_view where, std::string_view what)
    : Error(fmt::format("{}: {}: {}", file, where, what)) {}

std::string unknown_name(std::string_view kind, std::string_view name, std::span<const std::string> choices) {
  return fmt::format("unknown {} '{}', choose from {}", kind, name, fmt::join(choices, ", "));
}

}  // namespace fathom
