// The points of a cloud written as text.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace fathom {

/// The start of a damaged text, without bytes that must not reach a terminal.
std::string printable(std::string_view text);

/// Takes the first line off, without its end.
std::string_view take_line(std::string_view& text);
/// Takes the first word off a line; nothing when it has no more.
std::optional<std::string_view> take_word(std::string_view& line);
bool is_blank(std::string_view line);
/// The number that a word is, infinite or 0 where it is out of the type's range; nothing where it is no number. "nan"
/// and "inf" are numbers.
template <class Number>
std::optional<double> number_of(std::string_view word);

/// Numbers out of a body that is text, with one item on each line; empty lines do not count.
class TextNumbers {
 public:
  /// `first_line`: number of the body's first in the file, from 1. Keeps a reference to `file`.
  TextNumbers(const std::string& file, std::string_view body, std::uint64_t first_line)
      : file_(file), rest_(body), line_number_(first_line - 1) {}

  /// Goes on to the next item's line. Throws Error where there is none.
  void begin_item();
  /// The item's next number, rounded to a float if it `is_float`; what stands behind the last one that is asked for is
  /// left alone. Throws Error where there is none.
  double number(bool is_float);

 private:
  [[noreturn]] void fail(const std::string& what) const;

  const std::string& file_;
  std::string_view rest_, line_;
  std::uint64_t line_number_;
  std::uint64_t values_ = 0;
};

}  // namespace fathom
