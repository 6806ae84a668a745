#include "detector/pcd_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <optional>

#include "core/error.h"
#include "core/input_policy.h"
#include "detector/cloud_text.h"
#include "detector/header_lines.h"

namespace fathom {
namespace {

/// What there is at once while the points are read: the file, what PCL makes of it, and then the cloud.
std::uint64_t claimed_bytes(const std::string& encoding, std::uint64_t file_bytes, std::uint64_t points,
                            std::uint64_t point_bytes) {
  constexpr std::uint64_t kCloud = 4 * sizeof(float);  // of a point and its intensity
  constexpr std::uint64_t kTexts = 3;                  // PCL reads text from a stream, which is made of a copy
  const std::uint64_t unpacked = encoding == "binary_compressed" ? point_bytes : 0;  // gone before there is a cloud
  return bytes_of({file_bytes, encoding == "ascii" ? kTexts : 1}) +
         bytes_of({points, point_bytes + std::max(kCloud, unpacked)});
}

}  // namespace

PcdHeader check_pcd(const std::string& file, std::string_view content) {
  HeaderLines lines{file, content};
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
  require_within_limit(file, "header", claimed_bytes(encoding, content.size(), points, point_bytes), "points");
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
    constexpr std::uint64_t kMostPacked = 88;  // LZF stands for at most 264 bytes by 3
    if (sizes[1] > bytes_of({sizes[0], kMostPacked}))
      throw Error(file, fmt::format("is damaged: {} bytes cannot be packed in {}", sizes[1], sizes[0]));
  } else {
    throw Error(file, "DATA", fmt::format("must be ascii, binary or binary_compressed, got '{}'", printable(encoding)));
  }
  return {content.size() - lines.rest.size(), points * point_bytes};
}

}  // namespace fathom
