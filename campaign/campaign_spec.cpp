#include "campaign/campaign_spec.h"

#include <fmt/format.h>

#include <array>
#include <map>

#include "campaign/nominal_rig.h"
#include "core/error.h"
#include "core/table.h"
#include "core/units.h"
#include "sim/scene/medium_json.h"

namespace fathom {
namespace {

std::map<std::string, Medium> media_from_json(const JsonReader& json, double wavelength_nm) {
  if (!json.value().is_object()) json.fail("must be an object of liquids by name");
  std::map<std::string, Medium> media;
  for (const auto& [name, medium] : json.value().items()) {
    if (name == "empty" || name == "none") json.fail_at(name, "is a reserved name and no liquid");
    if (!fits_in_cell(name))
      json.fail_at(name, "must be a name that frames.csv can hold: no line break, no NUL, no blank at its ends");
    media[name] = medium_from_json(json.at(name));
    media[name].name = name;  // effects of a liquid go by its label
    require_index(json.at(name), media[name], wavelength_nm);
  }
  return media;
}

CampaignFilling filling_from_json(const JsonReader& json, const std::map<std::string, Medium>& media, double deepest) {
  json.allow_only({"liquid", "fill_mm"});
  CampaignFilling filling{.liquid = json.text("liquid"), .medium = {}};
  if (filling.liquid == "empty") {
    if (json.has("fill_mm")) json.fail_at("fill_mm", "cannot stand beside \"empty\"");
    return filling;
  }
  const auto medium = media.find(filling.liquid);
  if (medium == media.end()) {
    std::vector<std::string> names{"empty"};
    for (const auto& entry : media) names.push_back(entry.first);
    json.fail_at("liquid", unknown_name("liquid", filling.liquid, names));
  }
  filling.medium = medium->second;
  filling.fill = json.metres("fill_mm", kPositive);
  if (filling.fill > deepest)
    json.fail_at("fill_mm", fmt::format("must be at most {:g}, the depth of the cup", mm_from_metres(deepest)));
  return filling;
}

/// Places of a cup along one axis of the desk, which reaches from `low` to `high` [m].
std::vector<double> places(const JsonReader& json, double low, double high) {
  std::vector<double> result;
  for (const JsonReader& item : json.items()) {
    result.push_back(metres_from_mm(item.number()));
    if (result.back() < low || result.back() > high)
      item.fail(fmt::format("must be a place on the desk, from {:g} to {:g}, got {}", mm_from_metres(low),
                            mm_from_metres(high), item.value().dump()));
  }
  return result;
}

/// 1 σ of a length that cannot vary by more than `most` [m].
double sigma(const JsonReader& json, std::string_view key, double otherwise_m, double most) {
  return json.metres_or(key, otherwise_m, {0.0, mm_from_metres(most)});
}

/// How well the laboratory knows its rig, as in the file that it writes.
void read_rig_sigma(const JsonReader& json, std::map<std::string, double>& sigma) {
  json.allow_only(
      {"height_mm", "pitch_deg", "roll_deg", "baseline_mm", "focal_px", "disparity_offset_px", "bottom_mm"});
  for (const auto& [key, value] : json.value().items()) sigma[key] = json.number(key, kNonNegative);
}

}  // namespace

CampaignSpec read_campaign_spec(const std::filesystem::path& path) {
  constexpr int kMany = 10000;
  const std::array<std::string, 2> modes{"photometric", "geometric"};
  CampaignSpec spec;
  spec.source = read_json(path);
  const JsonReader json(spec.source, path.string());
  json.allow_only({"$schema",
                   "sensor",
                   "desk",
                   "cup",
                   "liquids",
                   "fillings",
                   "distance_mm",
                   "lateral_mm",
                   "sessions",
                   "bare_desk_views",
                   "pours",
                   "placements",
                   "trials",
                   "frame_s",
                   "placement_s",
                   "pour_s",
                   "mode",
                   "fill_sigma_mm",
                   "placement_sigma_mm",
                   "rig_sigma",
                   "effects"});
  spec.rig = rig_from_json(json.at("sensor"));
  spec.desk = scene_from_json(json).desk;
  if (!spec.desk) json.fail_at("desk", "is what heights are measured from and cannot be null");
  json.at("cup").allow_only({"shape"});
  spec.cup = cup_shape_from_json(json.at("cup").at("shape"));
  const std::map<std::string, Medium> media = media_from_json(json.at("liquids"), spec.rig.sensor.wavelength_nm);
  for (const auto& [name, medium] : media) spec.media.push_back(medium);
  for (const JsonReader& item : json.at("fillings").items())
    spec.fillings.push_back(filling_from_json(item, media, spec.deepest_fill()));
  const Eigen::Vector2d low = spec.desk->centre - 0.5 * spec.desk->size,
                        high = spec.desk->centre + 0.5 * spec.desk->size;
  spec.distances = places(json.at("distance_mm"), low.y(), high.y());
  spec.laterals = json.has("lateral_mm") ? places(json.at("lateral_mm"), low.x(), high.x()) : std::vector<double>{0.0};
  spec.sessions = json.integer_or("sessions", spec.sessions, 1, kMany);
  spec.bare_desk_views = json.integer_or("bare_desk_views", spec.bare_desk_views, 0, kMany);
  if (spec.fillings.empty() && spec.bare_desk_views == 0)
    json.fail_at("fillings", "must hold at least one filling, where there are no bare_desk_views");
  for (const auto& [key, lengths] : {std::pair{"distance_mm", &spec.distances}, {"lateral_mm", &spec.laterals}})
    if (lengths->empty() && !spec.fillings.empty()) json.fail_at(key, "must hold at least one length");
  spec.frame_s = json.number_or("frame_s", spec.frame_s, kPositive);
  spec.placement_s = json.number_or("placement_s", spec.placement_s, kNonNegative);
  spec.pour_s = json.number_or("pour_s", spec.pour_s, kNonNegative);
  for (const JsonReader& effect : json.items_or_none("effects")) spec.effects.push_back(effect.value());
  spec.pours = json.integer_or("pours", spec.pours, 1, kMany);
  spec.placements = json.integer_or("placements", spec.placements, 1, kMany);
  spec.trials = json.integer_or("trials", spec.trials, 1, kMany);
  if (json.has("mode") && json.at("mode").choice(modes, "mode") == 1) spec.mode = CaptureMode::geometric;
  spec.nominal = nominal_rig(spec.rig, spec.cup, path.string());
  spec.nominal.fill_sigma_m = sigma(json, "fill_sigma_mm", spec.nominal.fill_sigma_m, spec.deepest_fill());
  // `measure` looks for a cup no farther than its radius from where it should stand.
  spec.nominal.placement_sigma_m =
      sigma(json, "placement_sigma_mm", spec.nominal.placement_sigma_m, spec.nominal.cup.widest());
  if (json.has("rig_sigma")) read_rig_sigma(json.at("rig_sigma"), spec.nominal.sigma);
  for (const auto& [name, medium] : spec.source["liquids"].items()) spec.nominal.liquids[name] = medium;
  return spec;
}

}  // namespace fathom
