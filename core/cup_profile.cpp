#include "core/cup_profile.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/json.h"
#include "core/units.h"

namespace fathom {
namespace {

std::vector<Eigen::Vector2d> profile_from_json(const JsonReader& json) {
  std::vector<Eigen::Vector2d> profile;
  for (const JsonReader& item : json.items()) {
    profile.push_back(item.vector2({0.0, kCupLengthMm.high}) * kMetresPerMm);
    if (profile.size() > 1 && profile.back().y() < profile[profile.size() - 2].y())
      item.fail("must not be lower than the point before it");
  }
  if (profile.size() < 3) json.fail("must hold at least 3 points, from the axis to the rim");
  if (profile.size() > kMostProfilePoints) json.fail(fmt::format("must hold at most {} points", kMostProfilePoints));
  if (profile.front().x() != 0.0) json.fail("must start on the axis (radius 0)");
  return profile;
}

/// Radius of a profile at a height, by linear interpolation.
double radius_at(const std::vector<Eigen::Vector2d>& profile, double height) {
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const Eigen::Vector2d &below = profile[i - 1], &above = profile[i];
    if (height > above.y() || above.y() == below.y()) continue;
    const double t = (height - below.y()) / (above.y() - below.y());
    return below.x() + std::clamp(t, 0.0, 1.0) * (above.x() - below.x());
  }
  return profile.back().x();
}

bool less_wide(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() < b.x(); }

/// The axis, an edge at its height, and the rim straight above that.
bool is_upright(const std::vector<Eigen::Vector2d>& profile) {
  return profile.size() == 3 && profile[1].y() == profile[0].y() && profile[2].x() == profile[1].x();
}

Json profile_json(const std::vector<Eigen::Vector2d>& profile) {
  Json points = Json::array();
  for (const Eigen::Vector2d& point : profile) points.push_back({mm_from_metres(point.x()), mm_from_metres(point.y())});
  return points;
}

}  // namespace

double CupProfile::inner_radius(double height_above_desk) const { return radius_at(inner, height_above_desk); }
double CupProfile::outer_radius(double height_above_desk) const { return radius_at(outer, height_above_desk); }

std::size_t CupProfile::bottom_points() const {
  std::size_t points = 1;
  while (points < inner.size() && inner[points].y() - inner[points - 1].y() < inner[points].x() - inner[points - 1].x())
    ++points;
  return points;
}

double CupProfile::narrowest() const {
  return std::min_element(inner.begin() + static_cast<std::ptrdiff_t>(bottom_points()) - 1, inner.end(), less_wide)
      ->x();
}

double CupProfile::widest() const { return std::max_element(outer.begin(), outer.end(), less_wide)->x(); }

bool CupProfile::is_straight() const { return is_upright(inner) && is_upright(outer); }

CupProfile straight_cup(double height, double bottom, double inner_radius, double outer_radius) {
  return {{{0.0, bottom}, {inner_radius, bottom}, {inner_radius, height}},
          {{0.0, 0.0}, {outer_radius, 0.0}, {outer_radius, height}}};
}

bool has_profile(const JsonReader& json) { return json.has("inner_profile_mm") || json.has("outer_profile_mm"); }

CupProfile cup_profile_from_json(const JsonReader& json) {
  if (!has_profile(json)) return straight_cup_from_json(json);
  for (const char* key : {"height_mm", "bottom_mm", "inner_radius_mm", "outer_radius_mm"})
    if (json.has(key)) json.fail_at(key, "cannot stand beside a profile, which already says it");
  const CupProfile cup{profile_from_json(json.at("inner_profile_mm")), profile_from_json(json.at("outer_profile_mm"))};
  if (cup.outer.front().y() != 0.0) json.fail_at("outer_profile_mm", "must start at height 0, on the desk");
  if (cup.inner.back().y() != cup.outer.back().y())
    json.fail_at("inner_profile_mm", "must end at the outer rim's height");
  if (cup.bottom() <= 0.0) json.fail_at("inner_profile_mm", "must start above the desk, at the bottom's thickness");
  for (const auto* profile : {&cup.inner, &cup.outer})
    for (const Eigen::Vector2d& point : *profile)
      if (point.y() >= cup.bottom() && cup.inner_radius(point.y()) >= cup.outer_radius(point.y()))
        json.fail_at("inner_profile_mm",
                     fmt::format("must stay inside outer_profile_mm, but meets it {:g} mm above the desk",
                                 mm_from_metres(point.y())));
  if (cup.inner.back().x() >= cup.outer.back().x()) json.fail_at("inner_profile_mm", "must end inside the outer rim");
  return cup;
}

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
