#include "diagnosis/measurement/laboratory_rig.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/cup_json.h"
#include "core/input_policy.h"
#include "core/lengths.h"
#include "core/library.h"
#include "core/units.h"

namespace fathom {
namespace {

double read_deg(const JsonReader& json, std::string_view key, Range range) {
  return radians_from_deg(json.number_or(key, 0.0, range));
}

void read_sigma(const JsonReader& owner, std::initializer_list<std::string_view> keys,
                std::map<std::string, double>& sigma) {
  if (!owner.has("sigma")) return;
  const JsonReader json = owner.at("sigma");
  json.allow_only(keys);
  for (const std::string_view key : keys)
    if (json.has(key)) sigma[std::string(key)] = json.number(key, kNonNegative);
}

/// Of the infrared camera at 640 x 480 [px], as spec sheets and OpenNI's drivers have it.
double usual_focal_px(std::string_view sensor_model) { return sensor_model.starts_with("kinect") ? 575.816 : 570.342; }

void read_sensor(const JsonReader& json, LaboratoryRig& rig) {
  json.allow_only({"model", "height_mm", "pitch_deg", "roll_deg", "baseline_mm", "focal_px", "disparity_offset_px",
                   "unit", "sigma"});
  rig.sensor_model = json.text("model");
  rig.height_m = json.metres("height_mm", kLengthMm);
  rig.pitch_rad = radians_from_deg(json.number("pitch_deg", {-90.0, 90.0}));
  rig.roll_rad = read_deg(json, "roll_deg", {-180.0, 180.0});
  rig.baseline_m = json.metres_or("baseline_mm", rig.baseline_m, kLengthMm);
  rig.focal_px = json.number_or("focal_px", usual_focal_px(rig.sensor_model), {1.0, 1e6});
  rig.disparity_offset_px = json.number_or("disparity_offset_px", rig.disparity_offset_px);
  if (json.has("unit")) rig.unit = learned_unit_from_json(json.at("unit"));
  read_sigma(json, {"height_mm", "pitch_deg", "roll_deg", "baseline_mm", "focal_px", "disparity_offset_px"}, rig.sigma);
}

constexpr std::array kLengthKeys{"height_mm", "bottom_mm", "inner_radius_mm", "outer_radius_mm"};

/// Lengths cannot change a cup whose walls lean: nobody could say where.
void require_lengths_of(const CupProfile& cup, const std::string& shape, const JsonReader& json) {
  constexpr double kSame_mm = 1e-3;
  const Json own_mm = lengths_json(cup);
  for (const auto& [key, own] : own_mm.items())
    if (const double own_length_mm = own; json.has(key) && !(std::abs(json.number(key) - own_length_mm) <= kSame_mm))
      json.fail_at(
          key, fmt::format("must be {:.6g} or left out: the walls of {} lean, its radii are those {:g} mm above the "
                           "desk; another cup takes inner_profile_mm and outer_profile_mm",
                           own_length_mm, shape, mm_from_metres(kRadiiAt_m)));
}

void read_cup(const JsonReader& json, LaboratoryRig& rig) {
  json.allow_only({"shape", "inner_profile_mm", "outer_profile_mm", "height_mm", "inner_radius_mm", "outer_radius_mm",
                   "bottom_mm", "sigma"});
  read_sigma(json, {"height_mm", "inner_radius_mm", "outer_radius_mm", "bottom_mm"}, rig.sigma);
  if (has_profile(json)) {
    rig.cup_shape = json.text_or("shape", "cup");
    rig.cup = cup_profile_from_json(json);
    return;
  }
  rig.cup_shape = json.text_or("shape", rig.cup_shape);
  const std::optional<CupProfile> known = library_cup(rig.cup_shape);
  if (known && !known->is_straight()) {
    require_lengths_of(*known, rig.cup_shape, json);
    rig.cup = *known;
    return;
  }
  if (!known)
    for (const char* length : kLengthKeys)
      if (!json.has(length))
        json.fail_at(length, fmt::format("is missing: {} is no cup of the library, whose lengths are known ({}); "
                                         "inner_profile_mm and outer_profile_mm describe one whose walls lean",
                                         rig.cup_shape, fmt::join(library_names("cups"), ", ")));
  rig.cup = straight_cup_from_json(json, known.value_or(rig.cup));
}

void read_liquids(const JsonReader& json, LaboratoryRig& rig) {
  if (!json.value().is_object()) json.fail("must be an object of liquids by name");
  for (const auto& [name, medium] : json.value().items()) {
    if (name == "empty" || name == "none") json.fail_at(name, "is a reserved name and no liquid");
    if (!medium.is_string() && !medium.is_object()) json.fail_at(name, "must be a medium's name or an inline medium");
    rig.liquids[name] = medium;
  }
}

}  // namespace

std::optional<CupProfile> library_cup(const std::string& name) {
  const std::vector<std::string> names = library_names("cups");
  if (std::find(names.begin(), names.end(), name) == names.end()) return std::nullopt;
  const std::filesystem::path file = library_file("cups", "cup shape", name, "", "");
  const Json text = read_json(file);
  return cup_profile_from_json(JsonReader(text, file.string()));
}

bool is_same_cup(const CupProfile& a, const CupProfile& b) {
  constexpr double kSame = 1e-6;  // [m]
  const auto near = [](const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
    return (p - q).lpNorm<Eigen::Infinity>() <= kSame;
  };
  return std::equal(a.inner.begin(), a.inner.end(), b.inner.begin(), b.inner.end(), near) &&
         std::equal(a.outer.begin(), a.outer.end(), b.outer.begin(), b.outer.end(), near);
}

Json cup_json_of(const LaboratoryRig& rig) {
  if (const auto known = library_cup(rig.cup_shape); known && is_same_cup(*known, rig.cup)) return rig.cup_shape;
  return rig.cup.is_straight() ? lengths_json(rig.cup) : profiles_json(rig.cup);
}

LaboratoryRig read_rig(const std::filesystem::path& path) {
  const Json value = read_json(path);
  const JsonReader json(value, path.string());
  json.allow_only({"sensor", "cup", "liquids", "fill_sigma_mm", "placement_sigma_mm", "session_mm", "session_deg"});
  LaboratoryRig rig;
  read_sensor(json.at("sensor"), rig);
  read_cup(json.at("cup"), rig);
  if (rig.height_m <= rig.cup.height())
    json.at("sensor").fail_at("height_mm", fmt::format("must be above {:g}, the height of the cup, got {:g}",
                                                       mm_from_metres(rig.cup.height()), mm_from_metres(rig.height_m)));
  read_liquids(json.at("liquids"), rig);
  rig.fill_sigma_m = json.metres_or("fill_sigma_mm", rig.fill_sigma_m, kLengthOrNoneMm);
  rig.placement_sigma_m = json.metres_or("placement_sigma_mm", rig.placement_sigma_m, kLengthOrNoneMm);
  rig.session_m = json.metres_or("session_mm", rig.session_m, kLengthOrNoneMm);
  rig.session_rad = radians_from_deg(json.number_or("session_deg", deg_from_radians(rig.session_rad), {0.0, 90.0}));
  return rig;
}

}  // namespace fathom
