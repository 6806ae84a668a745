#include "detector/cloud_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <optional>

#include "core/error.h"

namespace fathom {
namespace {

constexpr std::string_view kSpaces = " \t\r";

}  // namespace

std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

std::optional<std::string_view> take_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(kSpaces), line.size()));
  if (line.empty()) return std::nullopt;
  const std::string_view word = line.substr(0, line.find_first_of(kSpaces));
  line.remove_prefix(word.size());
  return word;
}

bool is_blank(std::string_view line) { return line.find_first_not_of(kSpaces) == std::string_view::npos; }

template <class Number>
std::optional<double> number_of(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  Number number;
  const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (problem == std::errc::invalid_argument || end != word.data() + word.size()) return std::nullopt;
  if (problem == std::errc::result_out_of_range) return std::strtod(std::string(word).c_str(), nullptr);
  return static_cast<double>(number);
}
template std::optional<double> number_of<float>(std::string_view);
template std::optional<double> number_of<double>(std::string_view);

std::string printable(std::string_view text) {
  std::string shown(text.substr(0, 40));
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return c < 32 || c > 126; }, '?');
  return shown;
}

void TextNumbers::begin_item() {
  do {
    if (rest_.empty())
      throw Error(file_,
                  fmt::format("is truncated: it ends after line {}, before the last point that the header promises",
                              line_number_));
    line_ = take_line(rest_);
    ++line_number_;
  } while (is_blank(line_));
  values_ = 0;
}

double TextNumbers::number(bool is_float) {
  const std::optional<std::string_view> word = take_word(line_);
  if (!word) fail(fmt::format("must hold more than {} numbers", values_));
  ++values_;
  const std::optional<double> number = is_float ? number_of<float>(*word) : number_of<double>(*word);
  if (!number) fail(fmt::format("must hold numbers, got '{}'", printable(*word)));
  return *number;
}

void TextNumbers::fail(const std::string& what) const {
  throw Error(file_, fmt::format("line {}", line_number_), what);
}

}  // namespace fathom
