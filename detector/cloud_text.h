// The points of a cloud written as text.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace fathom {

/// Where the points stand in a text file.
struct TextBody {
  std::string_view text;     ///< from the first line after the header
  std::uint64_t first_line;  ///< its number in the file, from 1
  std::uint64_t points;      ///< one a line; empty lines do not count
  std::uint64_t values;      ///< in a line, at least; more are left alone by readers
};

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

/// PCL reads a word as 0. Throws Error naming `file` and the line when a value is no number, a line is short or there
/// are too few of them. "nan" and "inf" are numbers.
void check_text_points(const std::string& file, TextBody body);

}  // namespace fathom
