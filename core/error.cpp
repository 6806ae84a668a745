#include "core/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

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

/// How many letters must be put in, taken out, replaced or swapped with the next one (Damerau, Levenshtein; a swapped
/// pair stays as it is).
std::size_t typing_errors(std::string_view typed, std::string_view meant) {
  std::vector<std::size_t> earlier, above(meant.size() + 1), row(meant.size() + 1);
  std::iota(above.begin(), above.end(), std::size_t{0});
  for (std::size_t i = 0; i < typed.size(); ++i) {
    row[0] = i + 1;
    for (std::size_t j = 0; j < meant.size(); ++j) {
      row[j + 1] = std::min({above[j + 1] + 1, row[j] + 1, above[j] + (typed[i] != meant[j])});
      if (i > 0 && j > 0 && typed[i] == meant[j - 1] && typed[i - 1] == meant[j])
        row[j + 1] = std::min(row[j + 1], earlier[j - 1] + 1);
    }
    earlier = std::exchange(above, row);
  }
  return above.back();
}

/// "; did you mean 'water'?" where one choice is near, else nothing.
std::string likely_meant(std::string_view name, std::span<const std::string> choices) {
  constexpr std::size_t kLongest = 100;  // what is longer is no mistyped name, and takes long to compare
  if (name.size() > kLongest || name.size() < 3) return {};
  std::size_t fewest = std::max<std::size_t>(1, (name.size() - 1) / 4) + 1;
  std::string_view nearest;
  for (const std::string& choice : choices)
    if (const std::size_t errors = typing_errors(name, choice); errors < fewest) {
      fewest = errors;
      nearest = choice;
    }
  return nearest.empty() ? std::string() : fmt::format("; did you mean '{}'?", nearest);
}

}  // namespace

Error::Error(const std::string& message) : std::runtime_error(without_nul(message)) {}

Error::Error(std::string_view file, std::string_view what) : Error(fmt::format("{}: {}", file, what)) {}

Error::Error(std::string_view file, std::string_view where, std::string_view what)
    : Error(fmt::format("{}: {}: {}", file, where, what)) {}

std::string unknown_name(std::string_view kind, std::string_view name, std::span<const std::string> choices) {
  return fmt::format("unknown {} '{}', choose from {}{}", kind, name, fmt::join(choices, ", "),
                     likely_meant(name, choices));
}

std::string name_list(std::span<const std::string> names) {
  constexpr std::size_t kShown = 5;
  const std::string text = fmt::format("{}", fmt::join(names.first(std::min(names.size(), kShown)), ", "));
  return names.size() > kShown ? fmt::format("{} and {} more", text, names.size() - kShown) : text;
}

}  // namespace fathom
