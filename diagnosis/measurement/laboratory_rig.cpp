#include "diagnosis/measurement/laboratory_rig.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/cup_profile.h"
#include "core/fields.h"
#include "core/input_policy.h"
#include "core/library.h"
#include "core/range.h"
#include "core/units.h"
#include "diagnosis/measurement/cup_regions.h"

namespace fathom {
namespace {

/// Of the infrared camera at 640 x 480 [px], as spec sheets and OpenNI's drivers have it.
double usual_focal_px(std::string_view sensor_model) { return sensor_model.starts_with("kinect") ? 575.816 : 570.342; }

std::span<const Field<LaboratoryRig>> sensor_fields() {
  using Rig = LaboratoryRig;
  static const Field<Rig> fields[] = {
      {"model", &Rig::sensor_model, {}, "the sensor's: a name of `fathom list sensors`", true},
      {"height_mm", Length{&Rig::height_m}, kLengthMm, "height of the baseline's middle above the desk", true},
      {"pitch_deg", Angle{&Rig::pitch_rad}, {-90.0, 90.0}, "0: level, 90: straight down", true},
      {"roll_deg", Angle{&Rig::roll_rad}, {-180.0, 180.0}, "turn about the optical axis, clockwise from behind"},
      {"baseline_mm", Length{&Rig::baseline_m}, {10.0, 1000.0}, "from the camera to the projector"},
      {"focal_px",
       &Rig::focal_px,
       {200.0, 3000.0},
       "focal length at 640 × 480; of a Kinect 575.816 where it is not given"},
      {"disparity_offset_px", &Rig::disparity_offset_px, {-100.0, 100.0}, "what the disparities are off by"},
      {"unit",
       Part<Rig>{[](const JsonReader& json, Rig& rig) { rig.unit = learned_unit_from_json(json); }, nullptr,
                 R"({"type": "string"})", "a path"},
       {},
       "the sensor's unit.json of `fathom calibrate`: its bias is taken off every cloud before anything else"},
      {"sigma",
       Part<Rig>{[](const JsonReader& json, Rig& rig) {
                   std::vector<std::string_view> keys;
                   for (const RigValue& value : kRigValues)
                     if (value.of_sensor) keys.push_back(value.key);
                   read_sigmas(json, keys, rig.sigma);
                 },
                 nullptr, "#/$defs/sigma", "an object"},
       {},
       "one standard deviation of the values"}};
  return fields;
}

constexpr std::array<std::string_view, 4> kLengthKeys{"height_mm", "bottom_mm", "inner_radius_mm", "outer_radius_mm"};

std::span<const Field<LaboratoryRig>> cup_fields() {
  using Rig = LaboratoryRig;
  constexpr std::string_view kProfile = "../schema.json#/$defs/profile";
  static const Field<Rig> fields[] = {
      {"shape", &Rig::cup_shape, {}, "a name of `fathom list cups`; beside profiles a name and no more"},
      {"inner_profile_mm",
       Part<Rig>{nullptr, nullptr, kProfile, "points [radius, height]"},
       {},
       "the inside of a cup of one's own, from the axis to the rim"},
      {"outer_profile_mm", Part<Rig>{nullptr, nullptr, kProfile, "points [radius, height]"}, {}, "its outside"},
      {"height_mm", Part<Rig>{}, kCupLengthMm, "of the rim; lengths describe upright walls on a flat bottom"},
      {"inner_radius_mm", Part<Rig>{}, kCupLengthMm, "of the inside"},
      {"outer_radius_mm", Part<Rig>{}, kCupLengthMm, "of the outside"},
      {"bottom_mm", Part<Rig>{}, kCupLengthMm, "height of the inside's bottom"},
      {"sigma",
       Part<Rig>{[](const JsonReader& json, Rig& rig) {
                   std::map<std::string, double> sigma;
                   read_sigmas(json, kLengthKeys, sigma);
                   if (const auto bottom = sigma.find("bottom_mm"); bottom != sigma.end()) rig.sigma.insert(*bottom);
                 },
                 nullptr, "#/$defs/sigma", "an object"},
       {},
       "one standard deviation of the lengths, of which that of `bottom_mm` counts"}};
  return fields;
}

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
  read_fields(json, cup_fields(), rig);
  if (has_profile(json)) {
    if (!json.has("shape")) rig.cup_shape = "cup";
    rig.cup = cup_profile_from_json(json);
    return;
  }
  const std::optional<CupProfile> known = library_cup(rig.cup_shape);
  if (known && !known->is_straight()) {
    require_lengths_of(*known, rig.cup_shape, json);
    rig.cup = *known;
    return;
  }
  if (!known)
    for (const std::string_view length : kLengthKeys)
      if (!json.has(length))
        json.fail_at(length, fmt::format("is missing: {} is no cup of the library, whose lengths are known ({}); "
                                         "inner_profile_mm and outer_profile_mm describe one whose walls lean",
                                         rig.cup_shape, fmt::join(library_names("cups"), ", ")));
  rig.cup = straight_cup_from_json(json, known.value_or(rig.cup));
}

std::span<const Field<LaboratoryRig>> rig_fields() {
  using Rig = LaboratoryRig;
  static const Field<Rig> fields[] = {
      {"sensor",
       Part<Rig>{[](const JsonReader& json, Rig& rig) {
                   rig.focal_px = usual_focal_px(json.has("model") ? json.text("model") : "");
                   read_fields(json, sensor_fields(), rig);
                 },
                 nullptr, "#/$defs/sensor", "an object"},
       {},
       "the sensor as the laboratory believes it",
       true},
      {"cup",
       Part<Rig>{read_cup, nullptr, "#/$defs/cup", "an object"},
       {},
       "the cup as the laboratory believes it",
       true},
      {"liquids",
       Part<Rig>{[](const JsonReader& json, Rig& rig) { rig.liquids = media_by_label(json); }, nullptr,
                 R"({"type": "object"})", "an object"},
       {},
       "by label, each a name from `scenes/media` or a description",
       true},
      {"fill_sigma_mm", Length{&Rig::fill_sigma_m}, kLengthOrNoneMm,
       "by how much fills are off, one standard deviation"},
      {"placement_sigma_mm", Length{&Rig::placement_sigma_m}, kLengthOrNoneMm, "the same of places"},
      {"session_mm", Length{&Rig::session_m}, kLengthOrNoneMm,
       "by how much lengths of sessions, such as heights in cups, differ beside the sensor's pose, one standard "
       "deviation; the pose of each session may be off by `sensor.sigma`"},
      {"session_deg", Angle{&Rig::session_rad}, {0.0, 90.0}, "the same of angles"}};
  return fields;
}

/// Numbers for people: what is below a nanometre or a nanodegree is rounding.
double tidy(double value) { return std::round(value * 1e6) / 1e6 + 0.0; }

Json tidied(Json json) {
  if (json.is_number()) return tidy(json);
  if (json.is_structured())
    for (Json& part : json) part = tidied(part);
  return json;
}

/// By lengths where these say all: of straight cups, and of the library's by name. A name of the library that stands
/// for another cup needs the profiles if that one's walls lean.
Json cup_json(const LaboratoryRig& rig) {
  const std::optional<CupProfile> known = library_cup(rig.cup_shape);
  const bool by_lengths =
      (known && is_same_cup(*known, rig.cup)) || (rig.cup.is_straight() && (!known || known->is_straight()));
  Json json = {{"shape", rig.cup_shape}};
  json.update(by_lengths ? lengths_json(rig.cup) : profiles_json(rig.cup));
  return json;
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
  return laboratory_rig_from_json(JsonReader(value, path.string()));
}

LaboratoryRig laboratory_rig_from_json(const JsonReader& json) {
  LaboratoryRig rig;
  read_fields(json, rig_fields(), rig);
  constexpr double kLeastInside = 0.005;  // [m]
  if (interior_radius(rig.cup) < kLeastInside)
    json.fail_at(
        "cup", fmt::format("must have an inner radius of at least {:g} mm, because heights are taken {:g} mm from the "
                           "wall; got {:g}",
                           mm_from_metres(kInteriorMargin + kLeastInside), mm_from_metres(kInteriorMargin),
                           mm_from_metres(rig.cup.narrowest())));
  if (rig.height_m <= rig.cup.height())
    json.at("sensor").fail_at("height_mm", fmt::format("must be above {:g}, the height of the cup, got {:g}",
                                                       mm_from_metres(rig.cup.height()), mm_from_metres(rig.height_m)));
  return rig;
}

void read_sigmas(const JsonReader& json, std::span<const std::string_view> keys, std::map<std::string, double>& sigma) {
  json.allow_only(keys);
  for (const auto& [key, value] : json.value().items()) sigma[key] = json.number(key, kNonNegative);
}

std::map<std::string, SharedJson> media_by_label(const JsonReader& json) {
  if (!json.value().is_object()) json.fail("must be an object of liquids by name");
  std::map<std::string, SharedJson> media;
  for (const auto& [name, medium] : json.value().items()) {
    if (name == "empty" || name == "none") json.fail_at(name, "is a reserved name and no liquid");
    if (!medium.is_string() && !medium.is_object()) json.fail_at(name, "must be a medium's name or an inline medium");
    media[name] = medium;
  }
  return media;
}

Json json_from_laboratory_rig(const LaboratoryRig& rig) {
  const Json all = tidied(json_from_fields(rig_fields(), rig));
  Json sensor = tidied(json_from_fields(sensor_fields(), rig)), cup = tidied(cup_json(rig)), liquids = Json::object();
  for (const auto& [key, sigma] : rig.sigma) (key == "bottom_mm" ? cup : sensor)["sigma"][key] = sigma;
  for (const auto& [name, medium] : rig.liquids) liquids[name] = medium;
  return {{"sensor", sensor},
          {"cup", cup},
          {"liquids", liquids},
          {"fill_sigma_mm", all["fill_sigma_mm"]},
          {"placement_sigma_mm", all["placement_sigma_mm"]}};
}

std::vector<KeyRow> sigma_keys() {
  std::vector<KeyRow> rows;
  for (const RigValue& value : kRigValues)
    rows.push_back(number_key(value.key, fmt::format("of the {}'s `{}`", value.of_sensor ? "sensor" : "cup", value.key),
                              kNonNegative, value.usual_sigma));
  return rows;
}

std::vector<KeyTable> rig_key_tables() {
  const LaboratoryRig standard;
  return {{"", "", "The rig", key_rows(rig_fields(), standard)},
          {"sensor", "sensor", "Its sensor", key_rows(sensor_fields(), standard)},
          {"cup", "cup", "Its cup", key_rows(cup_fields(), standard)},
          {"sensor.sigma, cup.sigma", "sigma", "Standard deviations", sigma_keys()}};
}

}  // namespace fathom
