#include "core/cup_json.h"

#include "core/units.h"

namespace fathom {
namespace {

Json profile_json(const std::vector<Eigen::Vector2d>& profile) {
  Json points = Json::array();
  for (const Eigen::Vector2d& point : profile) points.push_back({mm_from_metres(point.x()), mm_from_metres(point.y())});
  return points;
}

}  // namespace

CupProfile straight_cup_from_json(const JsonReader& json, const std::optional<CupProfile>& usual) {
  const auto length = [&](const char* key, double (*of)(const CupProfile&)) {
    return usual && !json.has(key) ? of(*usual) : json.metres(key, kCupLengthMm);
  };
  const double height = length("height_mm", [](const CupProfile& cup) { return cup.height(); });
  const double bottom = length("bottom_mm", [](const CupProfile& cup) { return cup.bottom(); });
  const double inner = length("inner_radius_mm", [](const CupProfile& cup) { return cup.inner_radius(kRadiiAt_m); });
  const double outer = length("outer_radius_mm", [](const CupProfile& cup) { return cup.outer_radius(kRadiiAt_m); });
  if (bottom >= height) json.fail_at("bottom_mm", "must be below height_mm");
  if (outer <= inner) json.fail_at("outer_radius_mm", "must be above inner_radius_mm");
  return straight_cup(height, bottom, inner, outer);
}

Json lengths_json(const CupProfile& cup) {
  return {{"height_mm", mm_from_metres(cup.height())},
          {"inner_radius_mm", mm_from_metres(cup.inner_radius(kRadiiAt_m))},
          {"outer_radius_mm", mm_from_metres(cup.outer_radius(kRadiiAt_m))},
          {"bottom_mm", mm_from_metres(cup.bottom())}};
}

Json profiles_json(const CupProfile& cup) {
  return {{"inner_profile_mm", profile_json(cup.inner)}, {"outer_profile_mm", profile_json(cup.outer)}};
}

}  // namespace fathom
