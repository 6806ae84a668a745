#include "blind/pack_plan.h"

#include <array>
#include <stdexcept>

#include "core/rng.h"
#include "core/units.h"

namespace fathom::blind {
namespace {

const std::vector<Filling> kPaper{{"empty", 0},     {"water", 10},    {"water", 20},   {"water", 30},
                                  {"milk_tea", 10}, {"milk_tea", 20}, {"milk_tea", 30}};
const std::vector<Filling> kOpaque{{"milk_tea", 10}, {"milk_tea", 20}, {"milk_tea", 30}};
const std::vector<Filling> kWater{{"empty", 0}, {"water", 10}, {"water", 20}, {"water", 30}};

const std::array kDesigns{
    Design{"full", kPaper, {200, 300, 400}, {-120, 0, 120}, 3, 2, 0, true, true},
    Design{"bare_desk", kPaper, {200, 300, 400}, {-120, 0, 120}, 3, 2, 9, true, true},
    Design{"one_distance", kPaper, {300}, {-120, 0, 120}, 3, 3, 0, true, true},
    Design{"few_pours", kPaper, {200, 300, 400}, {-120, 0, 120}, 1, 3, 0, true, true},
    Design{"no_infrared", kPaper, {200, 300, 400}, {-120, 0, 120}, 3, 2, 0, false, true},
    Design{"heights_only", kPaper, {200, 300, 400}, {-120, 0, 120}, 3, 3, 0, false, false},
    Design{"opaque_only", kOpaque, {200, 300, 400}, {-120, 0, 120}, 3, 2, 0, true, true},
    Design{"water_one_distance", kWater, {300}, {0}, 3, 3, 0, true, true},
};

template <class T>
void shuffle(std::vector<T>& items, Rng& rng) {
  for (std::size_t i = items.size(); i > 1; --i)
    std::swap(items[i - 1], items[rng.below(static_cast<std::uint32_t>(i))]);
}

}  // namespace

std::span<const Design> designs() { return kDesigns; }

const Design& design(std::string_view name) {
  for (const Design& known : kDesigns)
    if (known.name == name) return known;
  throw std::logic_error("no such design: " + std::string(name));
}

std::vector<Placement> plan(const Design& design, std::uint64_t seed) {
  std::vector<Placement> placements;
  int pour = 0;
  for (int session = 0; session < design.pours; ++session) {
    Rng rng(seed, 0x0de8, session);
    std::vector<Filling> fillings = design.fillings;
    shuffle(fillings, rng);
    double clock = 0.0;
    for (const Filling& filling : fillings) {
      std::vector<std::pair<double, double>> places;
      for (const double distance : design.distance_mm)
        for (const double lateral : design.lateral_mm) places.emplace_back(distance, lateral);
      shuffle(places, rng);
      clock += kSecondsPerPour;
      const double poured = clock;
      for (const auto& [distance, lateral] : places) {
        placements.push_back({static_cast<int>(placements.size()), session, pour, filling.liquid,
                              metres_from_mm(filling.fill_mm), metres_from_mm(distance), metres_from_mm(lateral), clock,
                              clock - poured, design.trials});
        clock += kSecondsPerPlacement + design.trials * kSecondsPerTrial;
      }
      ++pour;
    }
    for (int view = session; view < design.bare_views; view += design.pours, clock += kSecondsPerPlacement)
      placements.push_back({.number = static_cast<int>(placements.size()),
                            .session = session,
                            .liquid = "none",
                            .time_s = clock,
                            .trials = design.trials});
  }
  return placements;
}

}  // namespace fathom::blind
