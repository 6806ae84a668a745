// Results for people and programs: rows `name value unit`, or one JSON object.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace fathom {

struct Row {
  std::string name;
  std::variant<double, std::string> value;
  std::string unit = "";  ///< "" for a plain number or a text
};

/// Aligned rows, or with `json` one object {"name": {"value": v, "unit": "u"}, …}. Ends with a newline.
std::string format_rows(const std::vector<Row>& rows, bool json);

}  // namespace fathom
