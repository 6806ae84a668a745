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

/// What there is at once while the points are read: the file, its points unpacked, and the cloud.
std::uint64_t claimed_bytes(PcdEncoding encoding, std::uint64_t file_bytes, std::uint64_t points,
                            std::uint64_t point_bytes) {
  constexpr std::uint64_t kCloud = 4 * sizeof(float);  // of a point and its intensity
  const std::uint64_t unpacked = encoding == PcdEncoding::packed ? point_bytes : 0;
  return file_bytes + bytes_of({points, kCloud + unpacked});
}

PcdEncoding encoding_named(const std::string& file, const std::string& name) {
  if (name == "ascii") return PcdEncoding::text;
  if (name == "binary") return PcdEncoding::binary;
  if (name == "binary_compressed") return PcdEncoding::packed;
  throw Error(file, "DATA", fmt::format("must be ascii, binary or binary_compressed, got '{}'", printable(name)));
}

}  // namespace

std::uint64_t PcdHeader::point_bytes() const {
  std::uint64_t sum = 0;
  for (const PcdField& field : fields) sum += field.bytes * field.count;
  return sum;
}

PcdHeader read_pcd_header(const std::string& file, std::string_view content) {
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

  PcdHeader header{};
  std::uint64_t values = 0;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::string& type = entries["TYPE"][i];
    const std::uint64_t size = whole_number(file, "SIZE", entries["SIZE"][i]);
    const std::uint64_t count = whole_number(file, "COUNT", counts[i]);
    const bool known = (type == "F" && (size == 4 || size == 8)) ||
                       ((type == "I" || type == "U") && (size == 1 || size == 2 || size == 4 || size == 8));
    constexpr std::uint64_t kMost = 4096;
    if (count < 1 || count > kMost)
      throw Error(file, "header",
                  fmt::format("has a COUNT of {} for '{}', must be from 1 to {}", count, printable(fields[i]), kMost));
    if (!known)
      throw Error(file, "header",
                  fmt::format("has an unknown type {}{} for '{}'", printable(type), size, printable(fields[i])));
    header.fields.push_back({fields[i], type[0], size, count});
    values += count;
  }
  const std::uint64_t width = whole_number(file, "WIDTH", entries["WIDTH"][0]);
  const std::uint64_t height = whole_number(file, "HEIGHT", entries["HEIGHT"][0]);
  const std::uint64_t points = whole_number(file, "POINTS", entries["POINTS"][0]);
  if (width * height != points)
    throw Error(file, "header", fmt::format("says {} x {} but {} points", width, height, points));

  header.columns = width, header.rows = height;
  header.body = lines.rest, header.body_line = lines.line;

  header.encoding = encoding_named(file, entries["DATA"][0]);
  const std::uint64_t point_bytes = header.point_bytes();
  require_within_limit(file, "header", claimed_bytes(header.encoding, content.size(), points, point_bytes), "points");
  if (header.encoding == PcdEncoding::text) {
    need_body(file, lines.rest.size() + 1, 2 * points * values);  // a digit and a separator each
  } else if (header.encoding == PcdEncoding::binary) {
    need_body(file, lines.rest.size(), points * point_bytes);
  } else {
    std::uint32_t sizes[2];  // packed, unpacked
    need_body(file, lines.rest.size(), sizeof sizes);
    std::memcpy(sizes, lines.rest.data(), sizeof sizes);
    need_body(file, lines.rest.size() - sizeof sizes, sizes[0]);
    if (sizes[1] != points * point_bytes)
      throw Error(file,
                  fmt::format("is damaged: {} bytes packed, the header promises {}", sizes[1], points * point_bytes));
    constexpr std::uint64_t kMostPacked = 88;  // LZF stands for at most 264 bytes by 3
    if (sizes[1] > bytes_of({sizes[0], kMostPacked}))
      throw Error(file, fmt::format("is damaged: {} bytes cannot be packed in {}", sizes[1], sizes[0]));
  }
  return header;
}

}  // namespace fathom
