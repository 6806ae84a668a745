#include "core/fields.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

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

KeyRow choice_row(std::span<const std::string> names) {
  KeyRow row;
  row.allowed = fmt::format("`{}`", fmt::join(names, "`, `"));
  row.schema = {{"enum", std::vector<std::string>(names.begin(), names.end())}};
  return row;
}

}  // namespace field_detail
}  // namespace fathom
