#include "detector/cloud_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "core/error.h"

namespace fathom {
namespace {

constexpr std::string_view kSpaces = " \t\r";

std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

/// Nothing when the line has no more words.
std::optional<std::string_view> take_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(kSpaces), line.size()));
  if (line.empty()) return std::nullopt;
  const std::string_view word = line.substr(0, line.find_first_of(kSpaces));
  line.remove_prefix(word.size());
  return word;
}

bool is_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double number;
  const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), number);
  return problem != std::errc::invalid_argument && end == word.data() + word.size();
}

}  // namespace

std::string printable(std::string_view text) {
  std::string shown(text.substr(0, 40));
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return c < 32 || c > 126; }, '?');
  return shown;
}

void check_text_points(const std::string& file, TextBody body) {
  std::uint64_t found = 0, before = 0;
  for (std::uint64_t number = body.first_line; found < body.points; ++number) {
    if (body.text.empty())
      throw Error(file,
                  fmt::format("is truncated: the header promises {} points, the file has {}", body.points, found));
    std::string_view line = take_line(body.text);
    std::uint64_t values = 0;
    if (line.find_first_not_of(kSpaces) == std::string_view::npos) continue;
    if (before++ < body.lines_before) continue;
    while (const std::optional<std::string_view> word = take_word(line)) {
      if (!is_number(*word))
        throw Error(file, fmt::format("line {}", number), fmt::format("must hold numbers, got '{}'", printable(*word)));
      ++values;
    }
    if (values < body.values)
      throw Error(file, fmt::format("line {}", number),
                  fmt::format("must hold {} numbers, has {}", body.values, values));
    ++found;
  }
}

}  // namespace fathom
