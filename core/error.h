// One kind of error for everything that comes from outside: files, their contents, the command line's values.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace fathom {

/// Something outside the program is wrong. what() is one line: "FILE: WHERE: what is wrong, what is allowed".
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message);
  Error(std::string_view file, std::string_view what);
  Error(std::string_view file, std::string_view where, std::string_view what);
};

/// "unknown liquid 'wtaer', choose from milk_tea, water; did you mean 'water'?"
std::string unknown_name(std::string_view kind, std::string_view name, std::span<const std::string> choices);

/// Many names in a sentence: "1, 2, 3, 4, 5 and 12 more"
std::string name_list(std::span<const std::string> names);

}  // namespace fathom
