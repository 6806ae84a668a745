#include "detector/cloud_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/files.h"
#include "detector/cloud_text.h"

namespace fathom {
namespace {

using Words = std::vector<std::string>;

constexpr std::uint64_t kMostPoints = 200'000'000;  // 20 times the largest scanner; keeps products below 2^63

/// Takes header lines off the front of a file's content.
struct HeaderLines {
  std::string_view rest;
  std::uint64_t line = 1;  ///< number of the next one

  std::optional<Words> next() {
    if (rest.empty()) return std::nullopt;
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    std::istringstream words_in_line{std::string(rest.substr(0, std::min<std::size_t>(end, 4096)))};
    rest.remove_prefix(std::min(end + 1, rest.size()));
    ++line;
    Words words;
    for (std::string word; words_in_line >> word;) words.push_back(word);
    return words;
  }
};

std::uint64_t whole_number(const std::string& file, const std::string& where, const std::string& word) {
  const bool digits = !word.empty() && word.size() <= 12 && word.find_first_not_of("0123456789") == std::string::npos;
  if (!digits || std::stoull(word) > kMostPoints)
    throw Error(file, where, fmt::format("must be a whole number up to {}, got '{}'", kMostPoints, printable(word)));
  return std::stoull(word);
}

void need_xyz(const std::string& file, const Words& names) {
  for (const char* needed : {"x", "y", "z"})
    if (std::find(names.begin(), names.end(), needed) == names.end())
      throw Error(file, "header", fmt::format("has no field '{}'; a cloud needs x, y and z", needed));
}

void need_body(const std::string& file, std::uint64_t found, std::uint64_t needed) {
  if (found < needed)
    throw Error(file, fmt::format("is truncated: the header promises at least {} bytes of points, the file has {}",
                                  needed, found));
}

void check_pcd(const std::string& file, HeaderLines lines) {
  static constexpr std::string_view kKeys[] = {"VERSION", "FIELDS", "SIZE",      "TYPE",   "COUNT",
                                               "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};
  std::map<std::string, Words> entries;
  while (!entries.contains("DATA")) {
    std::optional<Words> words = lines.next();
    if (!words) throw Error(file, "header", "ends before its line DATA");
    if (words->empty() || words->front().starts_with('#')) continue;
    const std::string key = words->front();
    if (std::find(std::begin(kKeys), std::end(kKeys), key) == std::end(kKeys) || entries.contains(key))
      throw Error(file, "header", fmt::format("has an unknown or a second line '{}'", printable(key)));
    words->erase(words->begin());
    entries[key] = std::move(*words);
  }
  for (const char* key : {"FIELDS", "SIZE", "TYPE", "WIDTH", "HEIGHT", "POINTS", "DATA"})
    if (entries[key].empty()) throw Error(file, "header", fmt::format("has no value for {}", key));
  const Words& fields = entries["FIELDS"];
  need_xyz(file, fields);
  Words& counts = entries["COUNT"];
  if (counts.empty()) counts.assign(fields.size(), "1");
  if (entries["SIZE"].size() != fields.size() || entries["TYPE"].size() != fields.size() ||
      counts.size() != fields.size())
    throw Error(file, "header", "must have as many values of SIZE, TYPE and COUNT as FIELDS");

  std::uint64_t point_bytes = 0, point_values = 0;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::string& type = entries["TYPE"][i];
    const std::uint64_t size = whole_number(file, "SIZE", entries["SIZE"][i]);
    const std::uint64_t count = whole_number(file, "COUNT", counts[i]);
    const bool known = (type == "F" && (size == 4 || size == 8)) ||
                       ((type == "I" || type == "U") && (size == 1 || size == 2 || size == 4 || size == 8));
    if (!known || count > 4096)
      throw Error(file, "header",
                  fmt::format("has an unknown type {}{} for '{}'", printable(type), size, printable(fields[i])));
    point_bytes += size * count;
    point_values += count;
  }
  const std::uint64_t width = whole_number(file, "WIDTH", entries["WIDTH"][0]);
  const std::uint64_t height = whole_number(file, "HEIGHT", entries["HEIGHT"][0]);
  const std::uint64_t points = whole_number(file, "POINTS", entries["POINTS"][0]);
  if (width * height != points)
    throw Error(file, "header", fmt::format("says {} x {} but {} points", width, height, points));

  const std::string& encoding = entries["DATA"][0];
  if (encoding == "ascii") {
    need_body(file, lines.rest.size() + 1, 2 * points * point_values);  // a digit and a separator each
    check_text_points(file, {lines.rest, lines.line, points, point_values});
  } else if (encoding == "binary") {
    need_body(file, lines.rest.size(), points * point_bytes);
  } else if (encoding == "binary_compressed") {
    std::uint32_t sizes[2];  // compressed, uncompressed
    need_body(file, lines.rest.size(), sizeof sizes);
    std::memcpy(sizes, lines.rest.data(), sizeof sizes);
    need_body(file, lines.rest.size() - sizeof sizes, sizes[0]);
    if (sizes[1] != points * point_bytes)
      throw Error(file,
                  fmt::format("is damaged: {} bytes packed, the header promises {}", sizes[1], points * point_bytes));
  } else {
    throw Error(file, "DATA", fmt::format("must be ascii, binary or binary_compressed, got '{}'", printable(encoding)));
  }
}

void check_ply(const std::string& file, HeaderLines lines) {
  static const std::map<std::string, std::uint64_t> sizes{{"char", 1},  {"uchar", 1},  {"short", 2},   {"ushort", 2},
                                                          {"int", 4},   {"uint", 4},   {"float", 4},   {"double", 8},
                                                          {"int8", 1},  {"uint8", 1},  {"int16", 2},   {"uint16", 2},
                                                          {"int32", 4}, {"uint32", 4}, {"float32", 4}, {"float64", 8}};
  std::string encoding, element;
  std::optional<std::uint64_t> vertices;
  std::uint64_t others = 0, lines_before = 0, vertex_bytes = 0;
  Words names;
  for (;;) {
    const std::optional<Words> words = lines.next();
    if (!words) throw Error(file, "header", "ends before its line end_header");
    if (words->empty()) continue;
    const std::string& key = words->front();
    if (key == "end_header") break;
    if (key == "format" && words->size() == 3) {
      encoding = (*words)[1];
    } else if (key == "element" && words->size() == 3) {
      element = (*words)[1];
      const std::uint64_t count = whole_number(file, "element " + printable(element), (*words)[2]);
      if (element == "vertex")
        vertices = count, lines_before = others;
      else
        others += count;
    } else if (key == "property" && words->size() == 3) {
      const auto size = sizes.find((*words)[1]);
      if (size == sizes.end())
        throw Error(file, "header",
                    fmt::format("has an unknown type '{}' for '{}'", printable((*words)[1]), printable((*words)[2])));
      if (element != "vertex") continue;
      names.push_back((*words)[2]);
      vertex_bytes += size->second;
    }
  }
  if (encoding != "ascii" && encoding != "binary_little_endian" && encoding != "binary_big_endian")
    throw Error(file, "format",
                fmt::format("must be ascii, binary_little_endian or binary_big_endian, got '{}'", printable(encoding)));
  if (!vertices) throw Error(file, "header", "has no element vertex");
  need_xyz(file, names);
  const bool ascii = encoding == "ascii";
  need_body(file, lines.rest.size() + (ascii ? 1 : 0),
            *vertices * (ascii ? 2 * names.size() : vertex_bytes) + others);  // any other element takes a byte or more
  if (ascii) check_text_points(file, {lines.rest, lines.line, *vertices, names.size(), lines_before});
}

}  // namespace

CloudFormat check_cloud_header(const std::filesystem::path& path) {
  const std::string content = read_text(path);
  const std::string file = path.string();
  if (content.empty()) throw Error(file, "is empty, expected a PCD or PLY cloud");
  if (content.starts_with("ply\n") || content.starts_with("ply\r\n")) {
    check_ply(file, {content});
    return CloudFormat::kPly;
  }
  if (content.starts_with('#') || content.starts_with("VERSION") || content.starts_with("FIELDS")) {
    check_pcd(file, {content});
    return CloudFormat::kPcd;
  }
  throw Error(file, "is neither PCD nor PLY");
}

}  // namespace fathom
