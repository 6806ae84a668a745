#include "app/campaign_spec.h"

#include <fmt/format.h>

#include <array>
#include <map>

#include "app/nominal_rig.h"
#include "core/error.h"
#include "core/units.h"

namespace fathom {
namespace {

std::map<std::string, Medium> media_from_json(const JsonReader& json) {
  if (!json.value().is_object()) json.fail("must be an object of liquids by name");
  std::map<std::string, Medium> media;
  for (const auto& [name, medium] : json.value().items()) {
    if (name == "empty" || name == "none") json.fail_at(name, "is a reserved name and no liquid");
    if (name.find_first_of(",\"\n") != std::string::npos) json.fail_at(name, "must be a name without , and \"");
    media[name] = medium_from_json(json.at(name));
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
  filling.fill = metres_from_mm(json.number("fill_mm", kPositive));
  if (filling.fill > deepest)
    json.fail_at("fill_mm", fmt::format("must be at most {:g}, the depth of the cup", mm_from_metres(deepest)));
  return filling;
}

std::vector<double> lengths(const JsonReader& json) {
  std::vector<double> result = json.numbers();
  if (result.empty()) json.fail("must hold at least one length");
  for (double& value : result) value = metres_from_mm(value);
  return result;
}

double sigma(const JsonReader& json, std::string_view key, double otherwise_m) {
  return metres_from_mm(json.number_or(key, mm_from_metres(otherwise_m), kNonNegative));
}

}  // namespace

CampaignSpec read_campaign_spec(const std::filesystem::path& path) {
  constexpr int kMany = 10000;
  const std::array<std::string, 2> modes{"photometric", "geometric"};
  CampaignSpec spec;
  spec.source = read_json(path);
  const JsonReader json(spec.source, path.string());
  json.allow_only({"sensor", "desk", "cup", "liquids", "fillings", "distance_mm", "lateral_mm", "pours", "placements",
                   "trials", "mode", "fill_sigma_mm", "placement_sigma_mm"});
  spec.rig = rig_from_json(json.at("sensor"));
  spec.desk = scene_from_json(json).desk;
  if (!spec.desk) json.fail_at("desk", "is what heights are measured from and cannot be null");
  json.at("cup").allow_only({"shape"});
  spec.cup = cup_shape_from_json(json.at("cup").at("shape"));
  const std::map<std::string, Medium> media = media_from_json(json.at("liquids"));
  for (const JsonReader& item : json.at("fillings").items())
    spec.fillings.push_back(filling_from_json(item, media, spec.deepest_fill()));
  if (spec.fillings.empty()) json.fail_at("fillings", "must hold at least one filling");
  spec.distances = lengths(json.at("distance_mm"));
  spec.laterals = json.has("lateral_mm") ? lengths(json.at("lateral_mm")) : std::vector<double>{0.0};
  spec.pours = json.integer_or("pours", spec.pours, 1, kMany);
  spec.placements = json.integer_or("placements", spec.placements, 1, kMany);
  spec.trials = json.integer_or("trials", spec.trials, 1, kMany);
  if (json.has("mode") && json.at("mode").choice(modes, "mode") == 1) spec.mode = CaptureMode::geometric;
  spec.nominal = nominal_rig(spec.rig, spec.cup, path.string());
  spec.nominal.fill_sigma_m = sigma(json, "fill_sigma_mm", spec.nominal.fill_sigma_m);
  spec.nominal.placement_sigma_m = sigma(json, "placement_sigma_mm", spec.nominal.placement_sigma_m);
  for (const auto& [name, medium] : spec.source["liquids"].items()) spec.nominal.liquids[name] = medium;
  return spec;
}

}  // namespace fathom
