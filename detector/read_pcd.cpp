// By hand, because PCL's reader is in a library that brings VTK and some fifty more. With them and PCL's libraries of
// templates the program takes 0.20 s and 71 MB to start, without them 0.01 s and 14 MB. LZF is liblzf's.
#include "detector/read_pcd.h"

#include <fmt/format.h>
#include <liblzf/lzf.h>

#include <algorithm>
#include <cstring>
#include <optional>

#include "core/error.h"
#include "detector/cloud_text.h"
#include "detector/pcd_header.h"

namespace fathom {
namespace {

/// The values of one field in a body, by the number of their point.
struct Column {
  char type;
  std::uint64_t bytes;   ///< of a value
  std::uint64_t first;   ///< where that of point 0 stands: a byte, or of text the number of its word in a line
  std::uint64_t stride;  ///< [bytes] from one point's to the next
};

template <class T>
float value_as(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<float>(value);
}

float number_at(const Column& column, const char* bytes) {
  const bool is_natural = column.type == 'U';
  if (column.type == 'F') return column.bytes == 4 ? value_as<float>(bytes) : value_as<double>(bytes);
  switch (column.bytes) {
    case 1:
      return is_natural ? value_as<std::uint8_t>(bytes) : value_as<std::int8_t>(bytes);
    case 2:
      return is_natural ? value_as<std::uint16_t>(bytes) : value_as<std::int16_t>(bytes);
    case 4:
      return is_natural ? value_as<std::uint32_t>(bytes) : value_as<std::int32_t>(bytes);
    default:
      return is_natural ? value_as<std::uint64_t>(bytes) : value_as<std::int64_t>(bytes);
  }
}

/// Of the first field of that name, if there is one: the first of its values in each point.
std::optional<Column> column_of(const PcdHeader& header, std::string_view name) {
  std::uint64_t words = 0, bytes = 0;
  for (const PcdField& field : header.fields) {
    if (field.name == name) switch (header.encoding) {
        case PcdEncoding::text:
          return Column{field.type, field.bytes, words, 0};
        case PcdEncoding::binary:
          return Column{field.type, field.bytes, bytes, header.point_bytes()};
        case PcdEncoding::packed:  // one field after the other
          return Column{field.type, field.bytes, header.points() * bytes, field.bytes * field.count};
      }
    words += field.count;
    bytes += field.bytes * field.count;
  }
  return std::nullopt;
}

std::string unpacked(const std::string& file, const PcdHeader& header) {
  std::uint32_t sizes[2];  // packed, unpacked: the header has been held against them
  std::memcpy(sizes, header.body.data(), sizeof sizes);
  std::string bytes(sizes[1], '\0');
  const bool whole =
      sizes[1] == 0 || lzf_decompress(header.body.data() + sizeof sizes, sizes[0], bytes.data(), sizes[1]) == sizes[1];
  if (!whole) throw Error(file, "cannot be read: its points are damaged");
  return bytes;
}

/// Takes points out of a body, one after the other.
class PointReader {
 public:
  PointReader(const std::string& file, const PcdHeader& header)
      : text_(file, header.body, header.body_line), is_text_(header.encoding == PcdEncoding::text) {
    if (is_text_)
      for (const PcdField& field : header.fields)
        words_.resize(words_.size() + field.count, field.type == 'F' && field.bytes == 4);
    for (const char* name : {"x", "y", "z"}) columns_.push_back(*column_of(header, name));
    if (const auto intensity = column_of(header, "intensity")) columns_.push_back(*intensity);
    if (header.encoding == PcdEncoding::packed) unpacked_ = unpacked(file, header);
    bytes_ = header.encoding == PcdEncoding::packed ? std::string_view(unpacked_) : header.body;
    values_.resize(columns_.size());
  }
  PointReader(const PointReader&) = delete;
  PointReader& operator=(const PointReader&) = delete;

  bool has_intensity() const { return columns_.size() > 3; }

  /// x, y, z and intensity, if it is there, of the next point.
  const std::vector<float>& next() {
    if (is_text_)
      read_line();
    else
      for (std::size_t i = 0; i < columns_.size(); ++i)
        values_[i] = number_at(columns_[i], bytes_.data() + columns_[i].first + point_ * columns_[i].stride);
    ++point_;
    return values_;
  }

 private:
  void read_line() {
    text_.begin_item();
    for (std::size_t word = 0; word < words_.size(); ++word) {
      const double number = text_.number(words_[word]);
      for (std::size_t i = 0; i < columns_.size(); ++i)
        if (columns_[i].first == word) values_[i] = static_cast<float>(number);
    }
  }

  TextNumbers text_;
  bool is_text_;
  std::vector<bool> words_;  ///< of a line of text: whether each stands for a float
  std::vector<Column> columns_;
  std::string unpacked_;
  std::string_view bytes_;
  std::uint64_t point_ = 0;
  std::vector<float> values_;
};

}  // namespace

Cloud read_pcd(const std::string& file, std::string_view content) {
  const PcdHeader header = read_pcd_header(file, content);
  PointReader reader(file, header);
  Cloud cloud;
  cloud.width = static_cast<int>(header.columns);
  cloud.height = static_cast<int>(header.rows);
  cloud.points.reserve(header.points());
  if (reader.has_intensity()) cloud.intensity.reserve(header.points());
  for (std::uint64_t i = 0; i < header.points(); ++i) {
    const std::vector<float>& values = reader.next();
    cloud.points.emplace_back(values[0], values[1], values[2]);
    if (reader.has_intensity()) cloud.intensity.push_back(values[3]);
  }
  return cloud;
}

}  // namespace fathom
