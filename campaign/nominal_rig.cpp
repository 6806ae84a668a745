#include "campaign/nominal_rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/cup_json.h"
#include "core/error.h"
#include "core/library.h"
#include "core/units.h"

namespace fathom {
namespace {

/// Numbers for people: what is below a nanometre or a nanodegree is rounding.
double tidy(double value) { return std::round(value * 1e6) / 1e6 + 0.0; }

double tidy_mm(double metres) { return tidy(mm_from_metres(metres)); }

Json tidied(Json json) {
  if (json.is_number()) return tidy(json);
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
  json.update(tidied(by_lengths ? lengths_json(rig.cup) : profiles_json(rig.cup)));
  return json;
}

}  // namespace

LaboratoryRig nominal_rig(const Rig& rig, const CupShape& cup, const std::string& file) {
  const Eigen::Matrix3d world_from_camera = rig.world_from_camera.linear();
  const Eigen::Vector3d forward = world_from_camera.col(2);
  if (rig.sensor.name.empty())
    throw Error(file, "/sensor/model",
                fmt::format("is missing: a measurement's rig names its sensor, choose from {}; other keys change it",
                            fmt::join(library_names("sensors"), ", ")));
  constexpr double kRounding = 1e-9;
  if (std::abs(forward.x()) > kRounding || forward.y() < -kRounding)
    throw Error(file, "/sensor/aim_mm", "must lie straight ahead (x = 0, y ≥ 0): a measurement's rig knows no yaw");
  LaboratoryRig nominal;
  nominal.sensor_model = rig.sensor.name;
  nominal.height_m = 0.5 * (rig.camera_in_world() + rig.projector_in_world()).z();
  nominal.pitch_rad = std::atan2(-forward.z(), forward.y());
  nominal.roll_rad = roll_of(world_from_camera);
  nominal.baseline_m = rig.sensor.baseline;
  nominal.focal_px = rig.sensor.focal_px;
  nominal.cup_shape = cup.name;
  nominal.cup = cup;
  return nominal;
}

Json json_from_laboratory_rig(const LaboratoryRig& rig) {
  Json sensor = {{"model", rig.sensor_model},
                 {"height_mm", tidy_mm(rig.height_m)},
                 {"pitch_deg", tidy(deg_from_radians(rig.pitch_rad))},
                 {"roll_deg", tidy(deg_from_radians(rig.roll_rad))},
                 {"baseline_mm", tidy_mm(rig.baseline_m)},
                 {"focal_px", tidy(rig.focal_px)},
                 {"disparity_offset_px", rig.disparity_offset_px}};
  Json cup = cup_json(rig);
  for (const auto& [key, sigma] : rig.sigma) (key == "bottom_mm" ? cup : sensor)["sigma"][key] = sigma;
  Json liquids = Json::object();
  for (const auto& [name, medium] : rig.liquids) liquids[name] = medium;
  return {{"sensor", sensor},
          {"cup", cup},
          {"liquids", liquids},
          {"fill_sigma_mm", tidy_mm(rig.fill_sigma_m)},
          {"placement_sigma_mm", tidy_mm(rig.placement_sigma_m)}};
}

}  // namespace fathom
