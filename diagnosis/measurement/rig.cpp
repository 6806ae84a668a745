#include "diagnosis/measurement/rig.h"

#include <fmt/format.h>

#include "core/input_policy.h"
#include "core/lengths.h"
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
  if (json.has("unit")) rig.unit = path_named_in(json.file(), json.pointer() + "/unit", json.text("unit"));
  read_sigma(json, {"height_mm", "pitch_deg", "roll_deg", "baseline_mm", "focal_px", "disparity_offset_px"}, rig.sigma);
}

void read_cup(const JsonReader& json, LaboratoryRig& rig) {
  json.allow_only({"shape", "height_mm", "inner_radius_mm", "outer_radius_mm", "bottom_mm", "sigma"});
  const LaboratoryRig papers;
  rig.cup_shape = json.text_or("shape", papers.cup_shape);
  if (rig.cup_shape != papers.cup_shape)
    for (const char* length : {"height_mm", "inner_radius_mm", "outer_radius_mm", "bottom_mm"})
      if (!json.has(length)) json.fail_at(length, "is missing: only of the paper_cup are the lengths known");
  rig.cup_height_m = json.metres_or("height_mm", rig.cup_height_m, kLengthMm);
  rig.inner_radius_m = json.metres_or("inner_radius_mm", rig.inner_radius_m, kLengthMm);
  rig.outer_radius_m = json.metres_or("outer_radius_mm", rig.outer_radius_m, kLengthMm);
  rig.bottom_m = json.metres_or("bottom_mm", rig.bottom_m, kLengthOrNoneMm);
  if (rig.inner_radius_m > rig.outer_radius_m) json.fail_at("inner_radius_mm", "must not be above outer_radius_mm");
  if (rig.bottom_m >= rig.cup_height_m) json.fail_at("bottom_mm", "must be below height_mm");
  read_sigma(json, {"height_mm", "inner_radius_mm", "outer_radius_mm", "bottom_mm"}, rig.sigma);
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

LaboratoryRig read_rig(const std::filesystem::path& path) {
  const Json value = read_json(path);
  const JsonReader json(value, path.string());
  json.allow_only({"sensor", "cup", "liquids", "fill_sigma_mm", "placement_sigma_mm"});
  LaboratoryRig rig;
  read_sensor(json.at("sensor"), rig);
  read_cup(json.at("cup"), rig);
  if (rig.height_m <= rig.cup_height_m)
    json.at("sensor").fail_at("height_mm", fmt::format("must be above {:g}, the height of the cup, got {:g}",
                                                       mm_from_metres(rig.cup_height_m), mm_from_metres(rig.height_m)));
  read_liquids(json.at("liquids"), rig);
  rig.fill_sigma_m = json.metres_or("fill_sigma_mm", rig.fill_sigma_m, kLengthOrNoneMm);
  rig.placement_sigma_m = json.metres_or("placement_sigma_mm", rig.placement_sigma_m, kLengthOrNoneMm);
  return rig;
}

}  // namespace fathom
