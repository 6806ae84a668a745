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

/// Letters of the words that two names share, such as "tilt" of "tilt" and "surface_tilt"; words have three or more.
std::size_t letters_shared(std::string_view name, std::string_view choice) {
  constexpr std::string_view kBetween = "_-. ";
  const auto has_word = [&](std::string_view word) {
    for (std::size_t at = choice.find(word); at != std::string_view::npos; at = choice.find(word, at + 1)) {
      const std::size_t end = at + word.size();
      if ((at == 0 || kBetween.find(choice[at - 1]) != kBetween.npos) &&
          (end == choice.size() || kBetween.find(choice[end]) != kBetween.npos))
        return true;
    }
    return false;
  };
  std::size_t letters = 0;
  for (std::size_t begin = 0; begin < name.size();) {
    const std::size_t end = std::min(name.find_first_of(kBetween, begin), name.size());
    if (end - begin >= 3 && has_word(name.substr(begin, end - begin))) letters += end - begin;
    begin = end + 1;
  }
  return letters;
}

/// "; did you mean 'water'?" where one choice is spelled nearly so or shares a word, else nothing.
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
  if (nearest.empty()) {
    std::size_t most = 0;
    for (const std::string& choice : choices)
      if (const std::size_t letters = letters_shared(name, choice); letters > most) {
        most = letters;
        nearest = choice;
      }
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
