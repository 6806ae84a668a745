// By hand, because PCL's reader (1.13) writes past its memory on files that are right: vertices whose `blue` stands
// before their `red`, vertices with lists.
#include "detector/read_ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <limits>
#include <optional>

#include "core/error.h"
#include "detector/cloud_text.h"
#include "detector/ply_header.h"

namespace fathom {
namespace {

/// Numbers out of a binary body, one after the other.
class BinaryNumbers {
 public:
  BinaryNumbers(const std::string& file, const PlyHeader& header)
      : file_(file),
        rest_(header.body),
        swap_((header.encoding == PlyEncoding::big_endian) != (std::endian::native == std::endian::big)) {}

  void begin_item() {}

  double number(const PlyType& type) {
    std::array<char, 8> bytes{};
    const std::string_view taken = take(type.bytes);
    std::copy(taken.begin(), taken.end(), bytes.begin());
    if (swap_) std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(type.bytes));
    const auto as = [&](auto value) {
      std::memcpy(&value, bytes.data(), sizeof value);
      return static_cast<double>(value);
    };
    if (type.kind == PlyType::Kind::real) return type.bytes == 4 ? as(float{}) : as(double{});
    const bool natural = type.kind == PlyType::Kind::natural;
    if (type.bytes == 1) return natural ? as(std::uint8_t{}) : as(std::int8_t{});
    if (type.bytes == 2) return natural ? as(std::uint16_t{}) : as(std::int16_t{});
    return natural ? as(std::uint32_t{}) : as(std::int32_t{});
  }

  void skip_numbers(const PlyType& type, std::uint64_t count) { take(count * type.bytes); }

 private:
  std::string_view take(std::uint64_t count) {
    if (count > rest_.size()) throw Error(file_, "is truncated: its points or lists end before the header says");
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }

  const std::string& file_;
  std::string_view rest_;
  bool swap_;
};

/// Numbers out of a body that is text, with one item on each line.
class TextNumbers {
 public:
  TextNumbers(const std::string& file, const PlyHeader& header)
      : file_(file), rest_(header.body), number_(header.body_line - 1) {}

  void begin_item() {
    do {
      if (rest_.empty()) throw Error(file_, "is truncated: it has fewer lines than the header promises points");
      line_ = take_line(rest_);
      ++number_;
    } while (is_blank(line_));
    values_ = 0;
  }

  double number(const PlyType& type) {
    const std::optional<std::string_view> word = take_word(line_);
    if (!word) fail(fmt::format("must hold more than {} numbers", values_));
    ++values_;
    const std::optional<double> number = type.bytes == 4 ? number_of<float>(*word) : number_of<double>(*word);
    if (!number) fail(fmt::format("must hold numbers, got '{}'", printable(*word)));
    return *number;
  }

  void skip_numbers(const PlyType& type, std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) number(type);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw Error(file_, fmt::format("line {}", number_), what); }

  const std::string& file_;
  std::string_view rest_, line_;
  std::uint64_t number_;
  std::uint64_t values_ = 0;
};

/// Calls `visit(property's index, value)` for every property of one item that is no list.
template <class Numbers, class Visit>
void read_item(const std::string& file, const PlyElement& element, Numbers& numbers, Visit visit) {
  numbers.begin_item();
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    if (!property.length_type) {
      visit(i, numbers.number(property.type));
      continue;
    }
    const double length = numbers.number(*property.length_type);
    constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
    if (!(length >= 0.0 && length <= kMost))
      throw Error(file, fmt::format("has a list '{}' of {} values", printable(property.name), length));
    numbers.skip_numbers(property.type, static_cast<std::uint64_t>(length));
  }
}

std::optional<std::size_t> index_of(const PlyElement& element, std::string_view name) {
  for (std::size_t i = 0; i < element.properties.size(); ++i)
    if (element.properties[i].name == name && !element.properties[i].length_type) return i;
  return std::nullopt;
}

template <class Numbers>
void read_vertices(const std::string& file, const PlyElement& element, Numbers& numbers, Cloud& cloud) {
  const std::array<std::size_t, 3> xyz{*index_of(element, "x"), *index_of(element, "y"), *index_of(element, "z")};
  const std::optional<std::size_t> intensity = index_of(element, "intensity");
  cloud.points.reserve(element.count);
  if (intensity) cloud.intensity.reserve(element.count);
  for (std::uint64_t i = 0; i < element.count; ++i) {
    Eigen::Vector3f& point = cloud.points.emplace_back();
    read_item(file, element, numbers, [&](std::size_t property, double value) {
      for (int axis = 0; axis < 3; ++axis)
        if (property == xyz[static_cast<std::size_t>(axis)]) point[axis] = static_cast<float>(value);
      if (intensity && property == *intensity) cloud.intensity.push_back(static_cast<float>(value));
    });
  }
}

template <class Numbers>
Cloud read_body(const std::string& file, const PlyHeader& header, Numbers numbers) {
  Cloud cloud;
  std::uint64_t columns = header.columns, rows = header.rows;
  for (const PlyElement& element : header.elements) {
    if (element.properties.empty()) continue;
    if (element.name == "vertex") {
      read_vertices(file, element, numbers, cloud);
      continue;
    }
    const std::optional<std::size_t> across = index_of(element, "viewportx"), down = index_of(element, "viewporty");
    for (std::uint64_t i = 0; i < element.count; ++i)
      read_item(file, element, numbers, [&](std::size_t property, double value) {
        const bool size = element.name == "camera" && value >= 0.0 && value <= 1e9;
        if (size && property == across) columns = static_cast<std::uint64_t>(value);
        if (size && property == down) rows = static_cast<std::uint64_t>(value);
      });
  }
  const bool organised = columns * rows == cloud.points.size();
  cloud.width = static_cast<int>(organised ? columns : cloud.points.size());
  cloud.height = static_cast<int>(organised ? rows : 1);
  return cloud;
}

}  // namespace

Cloud read_ply(const std::string& file, std::string_view content) {
  const PlyHeader header = read_ply_header(file, content);
  return header.encoding == PlyEncoding::text ? read_body(file, header, TextNumbers(file, header))
                                              : read_body(file, header, BinaryNumbers(file, header));
}

}  // namespace fathom
