#include "blind/views.h"

#include <set>

#include "blind/laboratory.h"
#include "core/parallel.h"
#include "core/rng.h"

namespace fathom::blind {
namespace {

constexpr std::uint64_t kStanding = 0x57e6;  // the same dots and grains for every change
constexpr double kElsewhere = 10e-3;         // [m] a window: dots that fell into one fall into others

std::vector<Nuisance> all_nuisances() {
  std::vector<Nuisance> all;
  for (const Uncertain& value : uncertain_rig()) all.push_back({value.sigma, value.add, Shared::by_all});
  for (const Uncertain& value : dust()) all.push_back({value.sigma, value.add, Shared::by_all});
  all.push_back({kFillSigma,
                 [](World& world, double metres) {
                   if (world.fill > 0.0) world.fill += metres;
                 },
                 Shared::by_pour});
  for (const SessionError& error : session_errors()) all.push_back({error.sigma, error.add, Shared::by_session});
  all.push_back(
      {kPlacementSigma, [](World& world, double metres) { world.cup.centre.x() += metres; }, Shared::by_placement});
  all.push_back(
      {kPlacementSigma, [](World& world, double metres) { world.cup.centre.y() += metres; }, Shared::by_placement});
  return all;
}

Placement place_of_look(Placement placement, int number) {
  Rng rng(kStanding, number);
  placement.lateral += kElsewhere * (rng.uniform() - 0.5);
  placement.distance += kElsewhere * (rng.uniform() - 0.5);
  return placement;
}

/// The unit's bias changes what is read, not what light does.
std::array<View, kUnitWaves> views_of_unit(const Placement& placement) {
  std::array<View, kUnitWaves> views{};
  for (int number = 0; number < kLooks; ++number) {
    const Placement there = place_of_look(placement, number);
    World world = believed(there);
    const Look seen = look(world, there, kStanding + number);
    for (int wave = 0; wave < kUnitWaves; ++wave) {
      world.unit = {};
      world.unit[wave] = kNuisanceSigmas * unit_sigmas()[wave];
      views[wave][number] = readings_of(seen, world, there, 1);
    }
  }
  return views;
}

ConditionViews views_under(const Placement& placement, const std::set<int>& trials) {
  ConditionViews views{.believed = view(placement, [](World&, const Placement&) {}), .unit = views_of_unit(placement)};
  for (const Nuisance& nuisance : nuisances())
    views.nuisances.push_back(view(
        placement, [&](World& world, const Placement&) { nuisance.add(world, kNuisanceSigmas * nuisance.sigma); }));
  for (const Hidden& effect : hidden_effects())
    if (shows_in_means(effect) && !differs_by_placement(effect))
      views.typical[effect.name] =
          view(placement, [&](World& world, const Placement& there) { effect.apply(world, there, effect.typical); });
  for (const int number : trials) views.noise[number] = observe(believed(placement), placement, number, kStanding);
  return views;
}

}  // namespace

Condition condition_of(const Placement& placement) {
  return {placement.liquid, placement.fill, placement.distance, placement.lateral};
}

View view(const Placement& placement, const Change& change) {
  View seen;
  for (int number = 0; number < kLooks; ++number) {
    const Placement there = place_of_look(placement, number);
    World world = believed(there);
    change(world, there);
    seen[number] = observe(world, there, 1, kStanding + number);
  }
  return seen;
}

const std::vector<Nuisance>& nuisances() {
  static const std::vector<Nuisance> all = all_nuisances();
  return all;
}

Views views_of(std::span<const Design> designs) {
  Views views;
  std::vector<Placement> placements;  // one of each condition
  std::set<int> trials;
  for (const Design& design : designs) {
    trials.insert(design.trials);
    for (const Placement& placement : plan(design, 0))
      if (views.try_emplace(condition_of(placement)).second) placements.push_back(placement);
  }
  parallel_items(static_cast<int>(placements.size()),
                 [&](int i) { views.at(condition_of(placements[i])) = views_under(placements[i], trials); });
  return views;
}

}  // namespace fathom::blind
