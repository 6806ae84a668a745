// A diagnosis' folder as the page's data.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>

#include "core/cup_profile.h"
#include "core/error.h"
#include "core/range.h"
#include "core/table.h"
#include "core/units.h"
#include "diagnosis/measurement/cup_regions.h"
#include "report/cup_shots_json.h"
#include "report/diagnosis_words.h"
#include "report/observable_words.h"
#include "view/packed.h"
#include "view/scenes.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

/// Liquid, fill, distance and lateral, as residuals.csv writes them.
using ConditionKey = std::array<std::string, 4>;
/// Session, pour and placement, the same.
using PlacementName = std::array<std::string, 3>;

struct Shot {
  std::string frame;
  PlacementName placement;
  Eigen::Vector3d camera;               ///< [m] from below the cup's axis
  std::vector<Eigen::Vector3d> points;  ///< [m]
};

struct Condition {
  Factors factors;
  std::vector<std::size_t> rows;  ///< of the table: heights
};

std::string in_table(double number) { return fmt::format("{:g}", number); }

PlacementName placement_of_row(const Table& table, std::size_t row) {
  return {table.text(row, "session"), table.text(row, "pour"), table.text(row, "placement")};
}

std::vector<Condition> conditions_of(const Table& table) {
  std::vector<Condition> conditions;
  std::map<ConditionKey, std::size_t> numbers;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.text(row, "observable") != "height_mm") continue;
    Factors factors;
    factors.liquid = table.text(row, "liquid");
    factors.fill_mm = table.number(row, "fill_mm");
    factors.distance_mm = table.number(row, "distance_mm");
    factors.lateral_mm = table.number(row, "lateral_mm");
    const ConditionKey key{factors.liquid, in_table(factors.fill_mm), in_table(factors.distance_mm),
                           in_table(factors.lateral_mm)};
    const auto [number, is_new] = numbers.emplace(key, conditions.size());
    if (is_new) conditions.push_back({factors, {}});
    conditions[number->second].rows.push_back(row);
  }
  constexpr std::size_t kMost = 1000;
  if (conditions.empty()) throw Error(table.file(), "holds no heights of cups, which the view shows");
  if (conditions.size() > kMost)
    throw Error(table.file(), fmt::format("has {} conditions, at most {} are shown", conditions.size(), kMost));
  std::stable_sort(conditions.begin(), conditions.end(), [](const Condition& a, const Condition& b) {
    const auto key = [](const Factors& f) { return std::tie(f.liquid, f.fill_mm, f.distance_mm, f.lateral_mm); };
    return key(a.factors) < key(b.factors);
  });
  return conditions;
}

std::map<ConditionKey, Shot> shots_of(const JsonReader& json) {
  std::map<ConditionKey, Shot> shots;
  for (const JsonReader& one : json.items()) {
    constexpr int kMost = 1'000'000'000;
    const auto whole = [&](const char* key) { return std::to_string(one.at(key).integer(0, kMost)); };
    Shot shot{one.text("frame"), {whole("session"), whole("pour"), whole("placement")}, {}, {}};
    shot.camera = one.at("camera_mm").vector3(kPlaceMm).unaryExpr([](double mm) { return metres_from_mm(mm); });
    const std::vector<double> numbers = one.at("points_mm").numbers(kPlaceMm);
    if (numbers.size() % 3 != 0) one.fail_at("points_mm", "must be three numbers for each point");
    for (std::size_t i = 0; i < numbers.size(); i += 3)
      shot.points.emplace_back(metres_from_mm(numbers[i]), metres_from_mm(numbers[i + 1]),
                               metres_from_mm(numbers[i + 2]));
    shots.emplace(ConditionKey{one.text("liquid"), in_table(one.number("fill_mm")), in_table(one.number("distance_mm")),
                               in_table(one.number("lateral_mm"))},
                  std::move(shot));
  }
  return shots;
}

bool is_region(const std::string& name) {
  return name == kWholeInterior ||
         std::find(kCupRegionNames.begin(), kCupRegionNames.end(), name) != kCupRegionNames.end();
}

/// What is measured of one placement, by part of the cup, and what the model has there.
Json regions_json(const Table& table, const Condition& condition, const PlacementName& placement) {
  Json regions = Json::array();
  for (const std::size_t row : condition.rows) {
    if (placement_of_row(table, row) != placement) continue;
    const std::string& region = table.text(row, "region");
    if (!is_region(region)) table.fail(row, "region", "must be a part of a cup");
    const double measured = table.number(row, "measured");
    regions.push_back({{"region", region},
                       {"measured_mm", measured},
                       {"before_mm", measured - table.number(row, "before")},
                       {"after_mm", measured - table.number(row, "after")},
                       {"sigma_mm", table.number(row, "sigma")}});
  }
  return regions;
}

Json condition_json(const Table& table, const Condition& condition, const Shot* shot, const PlaceCode& code) {
  double before = 0.0, after = 0.0;
  std::set<PlacementName> placements;
  for (const std::size_t row : condition.rows) {
    before += table.number(row, "before") / static_cast<double>(condition.rows.size());
    after += table.number(row, "after") / static_cast<double>(condition.rows.size());
    placements.insert(placement_of_row(table, row));
  }
  const PlacementName shown =
      shot && placements.contains(shot->placement) ? shot->placement : placement_of_row(table, condition.rows.front());
  const Factors& f = condition.factors;
  Json json = {{"words", condition_words(f)}, {"liquid", f.liquid},
               {"fill_mm", f.fill_mm},        {"distance_mm", f.distance_mm},
               {"lateral_mm", f.lateral_mm},  {"before_mm", before},
               {"after_mm", after},           {"placements", placements.size()},
               {"placement", shown},          {"regions", regions_json(table, condition, shown)}};
  if (!shot || shot->placement != shown) return json;
  std::vector<std::int16_t> places;
  for (const Eigen::Vector3d& point : shot->points) code.add(point, places);
  json["shot"] = {{"frame", shot->frame}, {"camera", json_of(shot->camera)}, {"points", packed(places)}};
  return json;
}

Json profile_json(const std::vector<Eigen::Vector2d>& profile) {
  Json points = Json::array();
  for (const Eigen::Vector2d& point : profile) points.push_back({point.x(), point.y()});
  return points;
}

Json effects_json(const JsonReader& report) {
  Json words = Json::array();
  for (const JsonReader& effect : report.at("effects").items()) words.push_back(effect_words(effect.text("name")));
  return words;
}

}  // namespace

Json diagnosis_scene(const fs::path& folder) {
  const fs::path report_file = folder / "report.json";
  const Json report_json = read_json(report_file);
  const JsonReader report(report_json, report_file.string());
  const std::string verdict = report.text("verdict");
  if (verdict == "insufficient")
    report.fail_at("verdict", "is insufficient: nothing was compared that the view could show");
  const Table table = read_table(folder / "residuals.csv");
  const fs::path shots_file = folder / kShotsFile;
  const Json shots_json = read_json(shots_file);
  const JsonReader seen(shots_json, shots_file.string());
  const CupProfile cup = cup_profile_from_json(seen.at("cup"));
  const std::map<ConditionKey, Shot> shots = shots_of(seen.at("shots"));

  double farthest = cup.height();
  for (const auto& [key, shot] : shots)
    for (const Eigen::Vector3d& point : shot.points) farthest = std::max(farthest, point.cwiseAbs().maxCoeff());
  const PlaceCode code(farthest);
  Json conditions = Json::array();
  for (const Condition& condition : conditions_of(table)) {
    const Factors& f = condition.factors;
    const auto shot = shots.find({f.liquid, in_table(f.fill_mm), in_table(f.distance_mm), in_table(f.lateral_mm)});
    conditions.push_back(condition_json(table, condition, shot == shots.end() ? nullptr : &shot->second, code));
  }
  return {{"answer", report.text("answer")},
          {"effects", effects_json(report)},
          {"cup", {{"inner", profile_json(cup.inner)}, {"outer", profile_json(cup.outer)}}},
          {"within_m", metres_from_mm(seen.number("heights_within_mm", kLengthOrNoneMm))},
          {"step_m", code.step()},
          {"conditions", std::move(conditions)}};
}

}  // namespace fathom
