// Numbers as people write them: decimal, and nothing else in the text.
#pragma once

#include <charconv>
#include <concepts>
#include <optional>
#include <string_view>

namespace fathom {

/// The number that the whole text is, with at most one sign before it. Nothing when it is anything else: empty, with
/// blanks, hexadecimal, beyond what a T holds, infinite or no number.
template <class T>
requires std::integral<T> || std::floating_point<T> std::optional<T> decimal(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  T number{};
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (problem != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if constexpr (std::floating_point<T>)
    if (!(number - number == T{})) return std::nullopt;  // infinite or NaN
  return number;
}

}  // namespace fathom
