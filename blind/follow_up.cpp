#include "blind/follow_up.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "blind/laboratory.h"
#include "core/units.h"

namespace fathom::blind {
namespace {

constexpr std::array kCupboard{"empty", "water", "milk_tea", "opaque_liquid"};
constexpr Range kFills_mm{0.0, 75.0}, kDistances_mm{150.0, 550.0}, kLaterals_mm{-200.0, 200.0};
constexpr int kMany = 100;

void require_rig(const JsonReader& sensor) {
  constexpr double kSame = 1e-6;  // rig.json is rounded to it
  const Json believed = rig_json()["sensor"];
  for (const auto& [key, value] : sensor.value().items())
    if (!believed.contains(key) ||
        (value.is_number() ? std::abs(value.get<double>() - believed[key].get<double>()) > kSame
                           : value != believed[key]))
      sensor.fail_at(key, "must be as in rig.json: a set has one rig");
}

Filling filling_from(const JsonReader& json) {
  json.allow_only({"liquid", "fill_mm"});
  Filling filling{json.text("liquid"), json.number_or("fill_mm", 0.0, kFills_mm)};
  if (std::find(kCupboard.begin(), kCupboard.end(), filling.liquid) == kCupboard.end())
    json.fail_at("liquid", fmt::format("must be one of {}, got {}", fmt::join(kCupboard, ", "), filling.liquid));
  return filling;
}

}  // namespace

FollowUp read_follow_up(const std::filesystem::path& spec) {
  const Json file = read_json(spec);
  const JsonReader json(file, spec.string());
  json.allow_only({"sensor", "cup", "liquids", "fillings", "distance_mm", "lateral_mm", "bare_desk_views", "pours",
                   "placements", "trials", "placement_s", "fill_sigma_mm", "placement_sigma_mm"});
  require_rig(json.at("sensor"));
  FollowUp wanted{.fillings = {},
                  .distance_mm = json.at("distance_mm").numbers(kDistances_mm),
                  .lateral_mm = json.at("lateral_mm").numbers(kLaterals_mm),
                  .pours = json.integer_or("pours", 1, 1, kMany),
                  .placements = json.integer_or("placements", 1, 1, kMany),
                  .trials = json.integer_or("trials", 10, 1, kMany),
                  .bare_desk_views = json.integer_or("bare_desk_views", 0, 0, kMany),
                  .wait_s = json.number_or("placement_s", 0.0, kNonNegative),
                  .new_liquids = Json::object()};
  for (const JsonReader& filling : json.at("fillings").items()) wanted.fillings.push_back(filling_from(filling));
  const Json known = rig_json()["liquids"];
  for (const auto& [name, medium] : json.at("liquids").value().items())
    if (!known.contains(name)) wanted.new_liquids[name] = medium;
  return wanted;
}

std::vector<Placement> plan(const FollowUp& wanted, std::span<const Placement> earlier) {
  Placement next;  // has the numbers and the time of what comes next
  for (const Placement& p : earlier) {
    next.number = std::max(next.number, p.number + 1);
    next.session = std::max(next.session, p.session + 1);
    next.pour = std::max(next.pour, p.pour + 1);
  }
  std::vector<Placement> placements;
  if (wanted.bare_desk_views > 0) {
    next.liquid = "none", next.trials = wanted.bare_desk_views;
    placements.push_back(next);
    ++next.number;
    next.time_s += next.trials * kSecondsPerTrial;
  }
  next.trials = wanted.trials;
  for (const Filling& filling : wanted.fillings)
    for (int pour = 0; pour < wanted.pours; ++pour, ++next.pour) {
      next.time_s += kSecondsPerPour;
      next.liquid = filling.liquid, next.fill = metres_from_mm(filling.fill_mm);
      const double poured_s = next.time_s;
      for (const double distance_mm : wanted.distance_mm)
        for (const double lateral_mm : wanted.lateral_mm)
          for (int i = 0; i < wanted.placements; ++i, ++next.number) {
            next.distance = metres_from_mm(distance_mm), next.lateral = metres_from_mm(lateral_mm);
            next.since_poured_s = next.time_s - poured_s;
            placements.push_back(next);
            next.time_s += wanted.trials * kSecondsPerTrial + kSecondsPerPlacement + wanted.wait_s;
          }
    }
  return placements;
}

}  // namespace fathom::blind
