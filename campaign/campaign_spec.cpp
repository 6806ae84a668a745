#include "campaign/campaign_spec.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/fields.h"
#include "core/library.h"
#include "core/table.h"
#include "core/units.h"
#include "diagnosis/measurement/cup_in_sight.h"
#include "sim/scene/medium_json.h"

namespace fathom {
namespace {

void read_liquids(const JsonReader& json, CampaignSpec& spec) {
  spec.nominal.liquids = media_by_label(json);
  for (const auto& [name, ignored] : spec.nominal.liquids) {
    if (!fits_in_cell(name))
      json.fail_at(name, "must be a name that frames.csv can hold: no line break, no NUL, no blank at its ends");
    Medium& medium = spec.media.emplace_back(medium_from_json(json.at(name)));
    medium.name = name;  // effects of a liquid go by its label
    require_index(json.at(name), medium, spec.rig.sensor.wavelength_nm);
  }
}

std::span<const Field<CampaignFilling>> filling_fields() {
  static const Field<CampaignFilling> fields[] = {
      {"liquid", &CampaignFilling::liquid, {}, "`empty`, or a label of `liquids`", true},
      {"fill_mm", Length{&CampaignFilling::fill}, kPositive, "depth of the liquid, unless `empty`"}};
  return fields;
}

CampaignFilling filling_from_json(const JsonReader& json, const CampaignSpec& spec) {
  CampaignFilling filling;
  read_fields(json, filling_fields(), filling);
  if (filling.liquid == "empty") {
    if (json.has("fill_mm")) json.fail_at("fill_mm", "cannot stand beside \"empty\"");
    return filling;
  }
  const auto medium = std::ranges::find(spec.media, filling.liquid, &Medium::name);
  if (medium == spec.media.end()) {
    std::vector<std::string> names{"empty"};
    for (const Medium& one : spec.media) names.push_back(one.name);
    json.fail_at("liquid", unknown_name("liquid", filling.liquid, names));
  }
  filling.medium = *medium;
  json.at("fill_mm");  // must be there
  if (filling.fill > spec.deepest_fill())
    json.fail_at("fill_mm",
                 fmt::format("must be at most {:g}, the depth of the cup", mm_from_metres(spec.deepest_fill())));
  return filling;
}

/// Places of a cup along one axis (0: x, 1: y) of the desk.
std::vector<double> places(const JsonReader& json, const CampaignSpec& spec, int axis) {
  const double middle = spec.desk.centre[axis], half = 0.5 * spec.desk.size[axis];
  const double low = middle - half, high = middle + half;
  std::vector<double> result;
  for (const JsonReader& item : json.items()) {
    result.push_back(metres_from_mm(item.number()));
    if (result.back() < low || result.back() > high)
      item.fail(fmt::format("must be a place on the desk, from {:g} to {:g}, got {}", mm_from_metres(low),
                            mm_from_metres(high), item.value().dump()));
  }
  if (result.empty() && !spec.fillings.empty()) json.fail("must hold at least one length");
  return result;
}

std::span<const Field<CampaignSpec>> spec_fields() {
  using Spec = CampaignSpec;
  constexpr Range kMany{1.0, 10000.0}, kManyOrNone{0.0, kMany.high};
  constexpr std::string_view kNumbers = R"({"type": "array", "items": {"type": "number"}})";
  static const Field<Spec> fields[] = {
      schema_field<Spec>(),
      {"sensor",
       Part<Spec>{[](const JsonReader& json, Spec& spec) { spec.rig = rig_from_json(json); }, nullptr,
                  "../schema.json#/$defs/sensor", "an object"},
       {},
       "as in a scene: a model that looks straight ahead",
       true},
      {"desk",
       Part<Spec>{[](const JsonReader& json, Spec& spec) {
                    if (json.value().is_null()) json.fail("is what heights are measured from and cannot be null");
                    spec.desk = desk_from_json(json);
                  },
                  nullptr, "../schema.json#/$defs/desk", "an object"},
       {},
       "as in a scene"},
      {"cup",
       Part<Spec>{[](const JsonReader& json, Spec& spec) {
                    json.allow_only({"shape"});
                    spec.cup = cup_shape_from_json(json.at("shape"));
                    spec.nominal = nominal_rig(spec.rig, spec.cup, json.file());
                  },
                  nullptr, "#/$defs/cup", "`{\"shape\"}`"},
       {},
       "`shape` is a name from `scenes/cups`, or a description",
       true},
      {"liquids", Part<Spec>{read_liquids, nullptr, "#/$defs/liquids", "an object"}, {}, "media by label", true},
      {"fillings",
       Part<Spec>{[](const JsonReader& json, Spec& spec) {
                    for (const JsonReader& item : json.items()) spec.fillings.push_back(filling_from_json(item, spec));
                  },
                  nullptr, R"({"type": "array", "items": {"$ref": "#/$defs/filling"}})", "a list of objects"},
       {},
       "what is poured; may be none where there are `bare_desk_views`",
       true},
      {"distance_mm",
       Part<Spec>{[](const JsonReader& json, Spec& spec) { spec.distances = places(json, spec, 1); }, nullptr, kNumbers,
                  "a list of numbers"},
       {},
       "places of the cup, away from the sensor",
       true},
      {"lateral_mm",
       Part<Spec>{[](const JsonReader& json, Spec& spec) { spec.laterals = places(json, spec, 0); },
                  [](const Spec& spec) { return Json(spec.laterals); }, kNumbers, "a list of numbers"},
       {},
       "the same, to the sensor's right"},
      {"sessions", &Spec::sessions, kMany, "each pours and places everything anew; its time starts at 0"},
      {"bare_desk_views", &Spec::bare_desk_views, kManyOrNone,
       "shots of the desk without a cup when a session begins: the frames `none`"},
      {"pours", &Spec::pours, kMany, "of each filling"},
      {"placements", &Spec::placements, kMany, "of each pour at each place"},
      {"trials", &Spec::trials, kMany, "shots of each placement"},
      {"frame_s", &Spec::frame_s, kPositive, "from shot to shot"},
      {"placement_s", &Spec::placement_s, kNonNegative, "that putting down takes besides"},
      {"pour_s", &Spec::pour_s, kNonNegative, "that pouring takes besides"},
      {"mode",
       enum_choice<&Spec::mode, Spec>({"geometric", "photometric"}),
       {},
       "photometric: infrared images, in all light where a liquid lets it in by more than 0.05 mm before it scatters "
       "it back or an effect of light is on, else in direct light; geometric: exact refraction, images only of liquids "
       "that scatter"},
      {"fill_sigma_mm",
       Part<Spec>{[](const JsonReader& json, Spec& spec) {
                    spec.nominal.fill_sigma_m = metres_from_mm(json.number({0.0, mm_from_metres(spec.deepest_fill())}));
                  },
                  [](const Spec& spec) { return Json(mm_that_read_back(spec.nominal.fill_sigma_m)); }},
       kNonNegative, "standard deviation of true fills; at most the cup's depth"},
      {"placement_sigma_mm",
       // `measure` looks for a cup no farther than its radius from where it should stand.
       Part<Spec>{
           [](const JsonReader& json, Spec& spec) {
             spec.nominal.placement_sigma_m = metres_from_mm(json.number({0.0, mm_from_metres(spec.cup.widest())}));
           },
           [](const Spec& spec) { return Json(mm_that_read_back(spec.nominal.placement_sigma_m)); }},
       kNonNegative, "standard deviation of true places; at most the cup's radius"},
      {"rig_sigma",
       Part<Spec>{[](const JsonReader& json, Spec& spec) {
                    std::vector<std::string_view> keys;
                    for (const RigValue& value : kRigValues) keys.push_back(value.key);
                    read_sigmas(json, keys, spec.nominal.sigma);
                  },
                  nullptr, "#/$defs/rig_sigma", "an object"},
       {},
       "how well the laboratory knows its rig: true values scatter by these standard deviations, and rig.json says so"},
      {"effects",
       Part<Spec>{[](const JsonReader& json, Spec& spec) {
                    for (const JsonReader& effect : json.items()) spec.effects.push_back(effect.value());
                  },
                  nullptr, R"({"type": "array", "items": {"$ref": "../schema.json#/$defs/effect"}})",
                  "a list of objects"},
       {},
       "what is there and no laboratory knows of, by name and parameters"}};
  return fields;
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
  nominal.focal_px = rig.sensor.focal_px * kImageWidth_px / rig.sensor.width;
  nominal.cup_shape = cup.name;
  nominal.cup = cup;
  return nominal;
}

CampaignSpec read_campaign_spec(const std::filesystem::path& path) {
  CampaignSpec spec;
  spec.source = read_json(path);
  const JsonReader json(spec.source, path.string());
  read_fields(json, spec_fields(), spec);
  if (spec.fillings.empty() && spec.bare_desk_views == 0)
    json.fail_at("fillings", "must hold at least one filling, where there are no bare_desk_views");
  const Json rig = json_from_laboratory_rig(spec.nominal);
  laboratory_rig_from_json(JsonReader(rig, path.string() + ": its rig.json"));  // which will be read back
  if (spec.fillings.empty()) return spec;
  for (const double distance : spec.distances)
    for (const double lateral : spec.laterals)
      if (const Eigen::Vector2d place(lateral, distance); !is_in_sight(place, spec.nominal))
        json.fail_at("distance_mm", fmt::format("must be {}, got {:g}", words_in_sight(place, spec.nominal),
                                                mm_from_metres(distance)));
  return spec;
}

std::vector<KeyTable> campaign_key_tables() {
  std::vector<KeyRow> sigma = sigma_keys();
  for (KeyRow& row : sigma) row.standard = nullptr;  // exact where nothing is said
  return {{"", "", "The campaign", key_rows(spec_fields(), CampaignSpec{})},
          {"fillings[]", "filling", "A filling", key_rows(filling_fields(), CampaignFilling{})},
          {"rig_sigma", "rig_sigma", "What the laboratory does not know", std::move(sigma)}};
}

}  // namespace fathom
