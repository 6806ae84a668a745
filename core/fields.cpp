#include "core/fields.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "core/units.h"

namespace fathom {

double mm_that_read_back(double metres) {
  const double mm = mm_from_metres(metres), infinite = std::numeric_limits<double>::infinity();
  for (const double near : {mm, std::nextafter(mm, infinite), std::nextafter(mm, -infinite)})
    if (metres_from_mm(near) == metres) return near;
  return mm;
}

namespace field_detail {
namespace {

/// A whole number as one, "0" and not "0.0".
Json as_short(double number) {
  const auto whole = static_cast<std::int64_t>(number);
  return static_cast<double>(whole) == number ? Json(whole) : Json(number);
}

Json schema_of(Range range, const char* type) {
  Json schema = {{"type", type}};
  if (range.low > Range{}.low) schema[range.open_low ? "exclusiveMinimum" : "minimum"] = as_short(range.low);
  if (range.high < Range{}.high) schema["maximum"] = as_short(range.high);
  return schema;
}

std::string allowed_of(Range range) {
  const bool from = range.low > Range{}.low, to = range.high < Range{}.high;
  if (from && to)
    return fmt::format("{}{:.10g}{} {:.10g}", range.open_low ? "above " : "", range.low,
                       range.open_low ? ", at most" : " to", range.high);
  if (from) return fmt::format("{} {:.10g}", range.open_low ? "above" : "from", range.low);
  return to ? fmt::format("to {:.10g}", range.high) : "any";
}

}  // namespace

KeyRow number_row(Range range, bool is_whole) {
  KeyRow row;
  row.allowed = allowed_of(range);
  row.schema = schema_of(range, is_whole ? "integer" : "number");
  return row;
}

KeyRow vector_row(Range range) {
  KeyRow row;
  row.allowed = "[x, y], each " + allowed_of(range);
  row.schema = {{"type", "array"}, {"items", schema_of(range, "number")}, {"minItems", 2}, {"maxItems", 2}};
  return row;
}

KeyRow interval_row(Range range) {
  const KeyRow one = number_row(range, false), pair = vector_row(range);
  KeyRow row;
  row.allowed = one.allowed + ", or a pair of such";
  row.schema = {{"anyOf", {one.schema, pair.schema}}};
  return row;
}

KeyRow length_range_row() {
  KeyRow row = vector_row(kNonNegative);
  row.allowed = "[least, largest], from 0";
  return row;
}

KeyRow row_of(std::string_view schema, std::string_view allowed) {
  KeyRow row;
  row.allowed = allowed;
  row.schema = schema.starts_with('{') ? Json::parse(schema) : Json{{"$ref", schema}};
  return row;
}

Interval length_range_from_json(const JsonReader& json) {
  const Eigen::Vector2d range = json.vector2();
  if (range[0] < 0.0 || range[1] <= range[0]) json.fail("must be two rising lengths [low, high]");
  return {range[0], range[1]};
}

KeyRow choice_row(std::span<const std::string> names) {
  KeyRow row;
  row.allowed = fmt::format("`{}`", fmt::join(names, "`, `"));
  row.schema = {{"enum", std::vector<std::string>(names.begin(), names.end())}};
  return row;
}

}  // namespace field_detail

KeyRow number_key(std::string key, std::string meaning, Range range, Json standard) {
  KeyRow row = field_detail::number_row(range, false);
  row.schema["description"] = meaning;
  row.key = std::move(key), row.meaning = std::move(meaning), row.standard = std::move(standard);
  return row;
}

}  // namespace fathom
