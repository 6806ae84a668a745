#include "sim/scene/doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/json.h"

namespace fathom {
namespace {

/// Whether a length is below the limit and not 0. Of a place all coordinates are below, and not all are 0.
bool is_tiny(const Json& value, double limit_mm) {
  const auto below = [&](const Json& number) {
    return number.is_number() && std::fabs(number.get<double>()) < limit_mm;
  };
  const auto is_zero = [](const Json& number) { return number == 0; };
  if (!value.is_array()) return below(value) && !is_zero(value);
  return std::all_of(value.begin(), value.end(), below) && !std::all_of(value.begin(), value.end(), is_zero);
}

void doubt_length(const Json& object, const std::string& place, const char* key, double limit_mm,
                  std::vector<std::string>& sentences) {
  if (!object.is_object() || !object.contains(key) || !is_tiny(object[key], limit_mm)) return;
  sentences.push_back(
      fmt::format("{}/{}: {} mm; lengths are in millimetres, were metres meant?", place, key, object[key].dump()));
}

}  // namespace

std::vector<std::string> scene_doubts(const Json& scene) {
  std::vector<std::string> sentences;
  if (scene.contains("sensor"))
    for (const char* key : {"height_mm", "aim_mm"}) doubt_length(scene["sensor"], "/sensor", key, 10.0, sentences);
  if (!scene.contains("cups")) return sentences;
  for (std::size_t i = 0; i < scene["cups"].size(); ++i) {
    const Json& cup = scene["cups"][i];
    const std::string place = fmt::format("/cups/{}", i);
    for (const char* key : {"position_mm", "fill_mm"}) doubt_length(cup, place, key, 1.0, sentences);
    if (!cup.contains("shape")) continue;
    for (const char* key : {"height_mm", "inner_radius_mm", "outer_radius_mm"})
      doubt_length(cup["shape"], place + "/shape", key, 1.0, sentences);
  }
  return sentences;
}

}  // namespace fathom
