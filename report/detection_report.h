// What a detector found, for people and for programs.
#pragma once

#include <string>
#include <vector>

#include "core/json_fwd.h"
#include "core/rows.h"
#include "detector/detector.h"

namespace fathom {

/// {"plane", "segments", "cups", "candidates"}; "why" when there is no desk. What was not seen is null.
Json detection_json(const Detection& detection);

/// The same for one cloud, `cloud` first: "desk_height 650.0 mm", "cups 1", "cup0_liquid yes". What was not seen has no
/// row.
std::vector<Row> detection_rows(const std::string& cloud, const Detection& detection);

}  // namespace fathom
