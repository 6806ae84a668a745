#include "core/rows.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/json.h"

namespace fathom {

std::string format_rows(const std::vector<Row>& rows, bool json) {
  if (json) {
    Json object = Json::object();
    for (const Row& row : rows) object[row.name] = {{"value", row.value}, {"unit", row.unit}};
    return object.dump(2) + "\n";
  }
  std::size_t width = 0;
  for (const Row& row : rows) width = std::max(width, row.name.size());
  std::string text;
  for (const Row& row : rows)
    text += fmt::format("{:<{}}  {:>12.6g}{}{}\n", row.name, width, row.value, row.unit.empty() ? "" : " ", row.unit);
  return text;
}

}  // namespace fathom
