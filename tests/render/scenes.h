// Small scenes for the tests of light transport and of the sensor.
#pragma once

#include <fmt/format.h>

#include <string>

#include "core/units.h"
#include "sim/scene/setup.h"

namespace fathom {

/// The paper's cup with `fill_mm` of water (0: empty) at a distance, the sensor 650 mm high. `more` goes into "sensor".
inline Setup cup_setup(double fill_mm, double distance_mm, double aim_mm, const std::string& more = "") {
  const std::string liquid = fill_mm > 0.0 ? fmt::format(R"(, "liquid": "water", "fill_mm": {})", fill_mm) : "";
  return setup_from_json(
      Json::parse(fmt::format(R"({{"sensor": {{"model": "xtion_pro_live", "height_mm": 650, "aim_mm": [0, {}, 0]{}}},
                                   "cups": [{{"shape": "paper_cup", "position_mm": [0, {}]{}}}]}})",
                              aim_mm, more, distance_mm, liquid)),
      "test");
}

inline Setup desk_setup(const std::string& more = "") {
  return setup_from_json(
      Json::parse(fmt::format(
          R"({{"sensor": {{"model": "xtion_pro_live", "height_mm": 650, "aim_mm": [0, 400, 0]{}}}, "desk": {{}}}})",
          more)),
      "test");
}

/// Height of the inner bottom of the paper's cup above the desk [m].
inline constexpr double kPaperCupBottom = 0.007;

}  // namespace fathom
