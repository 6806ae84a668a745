#include "detector/header_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "core/error.h"
#include "detector/cloud_text.h"

namespace fathom {

std::optional<Words> HeaderLines::next() {
  constexpr std::uint64_t kMost = 10'000;  // a line takes microseconds, and a file may hold millions of comments
  if (rest.empty()) return std::nullopt;
  if (line > kMost) throw Error(file, "header", fmt::format("has more than {} lines", kMost));
  const std::size_t end = std::min(rest.find('\n'), rest.size());
  std::istringstream words_in_line{std::string(rest.substr(0, std::min<std::size_t>(end, 4096)))};
  rest.remove_prefix(std::min(end + 1, rest.size()));
  ++line;
  Words words;
  for (std::string word; words_in_line >> word;) words.push_back(word);
  return words;
}

std::uint64_t whole_number(const std::string& file, const std::string& where, const std::string& word) {
  constexpr std::uint64_t kMostPoints = 200'000'000;  // 20 times the largest scanner; keeps products below 2^63
  const bool digits = !word.empty() && word.size() <= 12 && word.find_first_not_of("0123456789") == std::string::npos;
  if (!digits || std::stoull(word) > kMostPoints)
    throw Error(file, where, fmt::format("must be a whole number up to {}, got '{}'", kMostPoints, printable(word)));
  return std::stoull(word);
}

void need_xyz(const std::string& file, const Words& fields) {
  for (const char* needed : {"x", "y", "z"})
    if (std::find(fields.begin(), fields.end(), needed) == fields.end())
      throw Error(file, "header", fmt::format("has no field '{}'; a cloud needs x, y and z", needed));
}

void need_body(const std::string& file, std::uint64_t found, std::uint64_t needed) {
  if (found < needed)
    throw Error(file, fmt::format("is truncated: the header promises at least {} bytes of points, the file has {}",
                                  needed, found));
}

}  // namespace fathom
