#include "bench/blind/draw.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "bench/blind/strength.h"
#include "core/rng.h"

namespace fathom::blind {
namespace {

struct Share {
  const char* name;
  int percent;
};
constexpr std::array kKinds{Share{"null", 30},    Share{"single", 30}, Share{"pair", 12},       Share{"triple", 3},
                            Share{"unknown", 15}, Share{"twins", 5},   Share{"book_keeping", 5}};
constexpr std::array kDesignShares{Share{"full", 35},      Share{"bare_desk", 15},   Share{"one_distance", 15},
                                   Share{"few_pours", 15}, Share{"no_infrared", 15}, Share{"heights_only", 5}};
constexpr std::array kBookKeeping{"label_swap", "unit_error", "wrong_cup", "flipped_axis", "duplicated_trial"};
constexpr double kWeakest = 2.0, kStrongest = 30.0;

enum class Draw : std::uint64_t { order = 201, set };

template <std::size_t N>
std::string by_share(const std::array<Share, N>& shares, Rng& rng) {
  int ticket = static_cast<int>(rng.below(100));
  for (const Share& share : shares)
    if ((ticket -= share.percent) < 0) return share.name;
  return shares.back().name;
}

double draw_strength(Rng& rng) { return kWeakest * std::pow(kStrongest / kWeakest, rng.uniform()); }

/// One that the set can show at all, and is not there yet.
std::optional<Truth> draw_effect(const Strengths& strengths, bool registered, const std::vector<Truth>& there, double s,
                                 Rng& rng) {
  std::vector<const Hidden*> choices;
  for (const Hidden& effect : hidden_effects())
    if (effect.registered == registered &&
        std::none_of(there.begin(), there.end(), [&](const Truth& t) { return t.active.effect == &effect; }))
      choices.push_back(&effect);
  constexpr int kTries = 6;
  for (int i = 0; i < kTries; ++i) {
    const Hidden* effect = choices[rng.below(static_cast<std::uint32_t>(choices.size()))];
    const double sign = rng.uniform() < 0.5 ? -1.0 : 1.0;
    const Active active{effect, strengths.departure_for(*effect, s, sign)};
    const double reached = strengths.of(active);
    if (reached >= 0.7 * kWeakest) return Truth{active, reached};
  }
  return std::nullopt;
}

struct Twins {
  const char* design;
  std::array<const char*, 2> effects;
};
constexpr std::array kTwins{Twins{"opaque_only", {"cup_bottom_height", "fill_offset"}},
                            Twins{"water_one_distance", {"refractive_index", "fill_scale"}}};

void hide_unknown(const Strengths& strengths, Rng& rng, SetTruth& truth) {
  const bool never_registered = rng.uniform() < 0.6;
  const auto hidden = draw_effect(strengths, !never_registered, {}, 2.0 * draw_strength(rng), rng);
  if (!hidden) return;
  truth.effects.push_back(*hidden);
  if (!never_registered) truth.left_out = hidden->active.effect->name;
  std::vector<const Hidden*> registry;
  for (const Hidden& effect : hidden_effects())
    if (effect.registered && effect.name != truth.left_out) registry.push_back(&effect);
  const Eigen::MatrixXd signature = strengths.signature(std::span(&hidden->active, 1));
  // What shows in the spread of repeats alone escapes every signature of a mean.
  truth.escape = signature.norm() > 0.0 ? strengths.escape(signature, registry) : hidden->strength;
}

void hide_twin(const Strengths& strengths, const Twins& twins, Rng& rng, SetTruth& truth) {
  const Hidden& effect = hidden_effect(twins.effects[rng.below(2)]);
  const double s = std::max(8.0, draw_strength(rng));
  const Active active{&effect, strengths.departure_for(effect, s, rng.uniform() < 0.5 ? -1.0 : 1.0)};
  truth.effects.push_back({active, strengths.of(active)});
  for (const char* name : twins.effects) truth.twins.emplace_back(name);
}

}  // namespace

std::vector<std::string> kinds_of_pack(std::uint64_t seed, int sets) {
  std::vector<std::string> kinds;
  int shares = 0, so_far = 0;
  for (const Share& kind : kKinds) {
    shares += kind.percent;
    for (const int until = (shares * sets + 50) / 100; so_far < until; ++so_far) kinds.emplace_back(kind.name);
  }
  Rng rng(seed, Draw::order);
  for (std::size_t i = kinds.size(); i > 1; --i)
    std::swap(kinds[i - 1], kinds[rng.below(static_cast<std::uint32_t>(i))]);
  return kinds;
}

SetTruth draw_set(std::uint64_t pack_seed, int number, int sets) {
  Rng rng(pack_seed, Draw::set, number);
  SetTruth truth{.number = number, .seed = rng.bits()};
  truth.kind = kinds_of_pack(pack_seed, sets)[number];
  truth.design = by_share(kDesignShares, rng);
  truth.heavy_tails = rng.uniform() < 0.1;
  const bool is_mis_scaled = truth.kind == "null" && rng.uniform() < 1.0 / 6.0;
  if (is_mis_scaled) truth.noise_scale = 0.8 + 0.4 * rng.uniform();
  if (truth.kind == "null") return truth;
  if (truth.kind == "book_keeping") {
    truth.design = "full";
    truth.book_keeping = kBookKeeping[rng.below(kBookKeeping.size())];
    return truth;
  }
  const Twins& twins = kTwins[rng.uniform() < 0.7 ? 0 : 1];
  if (truth.kind == "twins") truth.design = twins.design;
  const Design& chosen = design(truth.design);
  const Strengths strengths(chosen, plan(chosen, truth.seed), truth.noise_scale);
  if (truth.kind == "unknown") hide_unknown(strengths, rng, truth);
  if (truth.kind == "twins") hide_twin(strengths, twins, rng, truth);
  const int hidden = truth.kind == "single" ? 1 : truth.kind == "pair" ? 2 : truth.kind == "triple" ? 3 : 0;
  for (int i = 0; i < hidden; ++i)
    if (const auto effect = draw_effect(strengths, true, truth.effects, draw_strength(rng), rng))
      truth.effects.push_back(*effect);
  std::vector<Active> all;
  for (const Truth& effect : truth.effects) all.push_back(effect.active);
  truth.strength_by_liquid = strengths.by_liquid(strengths.signature(all));
  return truth;
}

Json json_of(const SetTruth& truth) {
  Json effects = Json::array();
  for (const Truth& hidden : truth.effects)
    effects.push_back({{"name", hidden.active.effect->name},
                       {"parameter", hidden.active.effect->parameter},
                       {"value", hidden.active.effect->nominal + hidden.active.departure},
                       {"s", hidden.strength},
                       {"registered", hidden.active.effect->registered}});
  Json by_liquid = Json::object();
  for (const auto& [liquid, s] : truth.strength_by_liquid) by_liquid[liquid] = s;
  return {{"set", truth.number},
          {"class", truth.kind},
          {"design", truth.design},
          {"effects", effects},
          {"book_keeping", truth.book_keeping},
          {"left_out", truth.left_out},
          {"twins", truth.twins},
          {"escape", truth.escape},
          {"noise_scale", truth.noise_scale},
          {"heavy_tails", truth.heavy_tails},
          {"strength_by_liquid", by_liquid}};
}

}  // namespace fathom::blind
