// Lines of a cloud's header, and what every header is asked.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fathom {

using Words = std::vector<std::string>;

/// Takes header lines off the front of a file's content.
struct HeaderLines {
  const std::string& file;
  std::string_view rest;
  std::uint64_t line = 1;  ///< number of the next one

  /// Its words; nothing at the file's end. Throws Error where there are more lines than a header has.
  std::optional<Words> next();
};

/// Throws Error where the word is no whole number, or one that no cloud needs.
std::uint64_t whole_number(const std::string& file, const std::string& where, const std::string& word);

/// Throws Error where x, y or z is not among the fields.
void need_xyz(const std::string& file, const Words& fields);

/// Throws Error where fewer bytes were found than points need.
void need_body(const std::string& file, std::uint64_t found, std::uint64_t needed);

}  // namespace fathom
