#include "detector/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "core/error.h"
#include "core/input_policy.h"
#include "detector/cloud_text.h"
#include "detector/header_lines.h"

namespace fathom {
namespace {

std::optional<PlyType> type_named(const std::string& name) {
  using enum PlyType::Kind;
  static const std::map<std::string, PlyType> types{
      {"char", {integer, 1}},  {"uchar", {natural, 1}},  {"short", {integer, 2}}, {"ushort", {natural, 2}},
      {"int", {integer, 4}},   {"uint", {natural, 4}},   {"float", {real, 4}},    {"double", {real, 8}},
      {"int8", {integer, 1}},  {"uint8", {natural, 1}},  {"int16", {integer, 2}}, {"uint16", {natural, 2}},
      {"int32", {integer, 4}}, {"uint32", {natural, 4}}, {"float32", {real, 4}},  {"float64", {real, 8}}};
  const auto found = types.find(name);
  return found == types.end() ? std::nullopt : std::optional(found->second);
}

class Parser {
 public:
  Parser(const std::string& file, std::string_view content)
      : file_(file), file_bytes_(content.size()), lines_{file, content} {}

  PlyHeader parse() {
    lines_.next();  // "ply"
    for (;;) {
      const std::optional<Words> words = lines_.next();
      if (!words) throw Error(file_, "header", "ends before its line end_header");
      if (words->empty() || words->front() == "comment") continue;
      if (words->front() == "end_header") break;
      read_line(*words);
    }
    header_.body = lines_.rest;
    header_.body_line = lines_.line;
    check();
    return std::move(header_);
  }

 private:
  void read_line(const Words& words) {
    const std::string& key = words.front();
    if (key == "format" && words.size() == 3)
      read_format(words[1]);
    else if (key == "obj_info")
      read_object_info(words);
    else if (key == "element" && words.size() == 3)
      header_.elements.push_back({words[1], whole_number(file_, "element " + printable(words[1]), words[2])});
    else if (key == "property" && words.size() == 3)
      add_property({words[2], type_of(words[1], words[2])});
    else if (key == "property" && words.size() == 5 && words[1] == "list")
      add_property({words[4], type_of(words[3], words[4]), type_of(words[2], words[4])});
    else
      throw Error(file_, "header", fmt::format("has an unknown line '{}'", printable(key)));
  }

  void read_format(const std::string& name) {
    constexpr std::string_view kNames[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    const auto found = std::find(std::begin(kNames), std::end(kNames), name);
    if (found == std::end(kNames))
      throw Error(file_, "format",
                  fmt::format("must be ascii, binary_little_endian or binary_big_endian, got '{}'", printable(name)));
    header_.encoding = PlyEncoding{static_cast<int>(found - std::begin(kNames))};
    has_format_ = true;
  }

  /// Scanners write the size of their grid there.
  void read_object_info(const Words& words) {
    if (words.size() != 3) return;
    if (words[1] == "num_cols") header_.columns = whole_number(file_, "obj_info num_cols", words[2]);
    if (words[1] == "num_rows") header_.rows = whole_number(file_, "obj_info num_rows", words[2]);
  }

  PlyType type_of(const std::string& name, const std::string& property) const {
    const std::optional<PlyType> type = type_named(name);
    if (!type)
      throw Error(file_, "header",
                  fmt::format("has an unknown type '{}' for '{}'", printable(name), printable(property)));
    return *type;
  }

  void add_property(PlyProperty property) {
    if (header_.elements.empty()) throw Error(file_, "header", "has a property before the first element");
    if (property.length_type && property.length_type->kind == PlyType::Kind::real)
      throw Error(file_, "header",
                  fmt::format("has a list '{}' whose length is no whole number", printable(property.name)));
    header_.elements.back().properties.push_back(std::move(property));
  }

  void check() const {
    if (!has_format_) throw Error(file_, "header", "has no line format");
    const auto is_vertex = [](const PlyElement& element) { return element.name == "vertex"; };
    const auto vertex = std::find_if(header_.elements.begin(), header_.elements.end(), is_vertex);
    if (vertex == header_.elements.end()) throw Error(file_, "header", "has no element vertex");
    if (std::count_if(header_.elements.begin(), header_.elements.end(), is_vertex) > 1)
      throw Error(file_, "header", "has the element vertex twice");
    Words fields;
    for (const PlyProperty& property : vertex->properties)
      if (!property.length_type) fields.push_back(property.name);
    need_xyz(file_, fields);
    std::uint64_t needed = 0;
    for (const PlyElement& element : header_.elements) needed += element.count * element.least_size(header_.encoding);
    const bool text = header_.encoding == PlyEncoding::text;  // whose last line needs no end
    need_body(file_, header_.body.size() + (text ? 1 : 0), needed);
    constexpr std::uint64_t kPoint = 4 * sizeof(float);                       // with its intensity
    constexpr std::uint64_t kPlace = sizeof(std::optional<double>) + kPoint;  // of a grid
    std::uint64_t claimed = file_bytes_ + bytes_of({vertex->count, kPoint});
    for (const PlyElement& element : header_.elements)
      if (element.name == "range_grid") claimed += bytes_of({element.count, kPlace});
    require_within_limit(file_, "header", claimed, "points");
  }

  const std::string& file_;
  std::uint64_t file_bytes_;
  HeaderLines lines_;
  PlyHeader header_;
  bool has_format_ = false;
};

}  // namespace

std::uint64_t PlyElement::least_size(PlyEncoding encoding) const {
  if (encoding == PlyEncoding::text) return 2 * properties.size();
  std::uint64_t bytes = 0;
  for (const PlyProperty& property : properties)
    bytes += property.length_type ? property.length_type->bytes : property.type.bytes;
  return bytes;
}

PlyHeader read_ply_header(const std::string& file, std::string_view content) { return Parser(file, content).parse(); }

}  // namespace fathom
