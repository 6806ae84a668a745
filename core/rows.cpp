#include "core/rows.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/json.h"
#include "core/visible_text.h"

namespace fathom {
namespace {

std::string text_of(double number) { return fmt::format("{:>12.6g}", number); }
std::string text_of(const std::string& text) { return fmt::format("{:>12}", on_one_line(text)); }

std::string text_of(const Row& row) {
  return std::visit([](const auto& value) { return text_of(value); }, row.value);
}

Json json_of(const Row& row) {
  return std::visit([](const auto& value) { return Json(value); }, row.value);
}

}  // namespace

std::string format_rows(const std::vector<Row>& rows, bool json) {
  if (json) {
    Json object = Json::object();
    for (const Row& row : rows) object[row.name] = {{"value", json_of(row)}, {"unit", row.unit}};
    return json_text(object);
  }
  std::size_t width = 0;
  for (const Row& row : rows) width = std::max(width, row.name.size());
  std::string text;
  for (const Row& row : rows)
    text += fmt::format("{:<{}}  {}{}{}\n", row.name, width, text_of(row), row.unit.empty() ? "" : " ", row.unit);
  return text;
}

}  // namespace fathom
