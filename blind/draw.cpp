#include "blind/draw.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "blind/strength.h"
#include "core/rng.h"

namespace fathom::blind {
namespace {

struct Share {
  const char* name;
  int percent;
};
constexpr std::array kKinds{Share{"null", 30},    Share{"single", 30}, Share{"pair", 12},       Share{"triple", 3},
                            Share{"unknown", 15}, Share{"aliased", 5}, Share{"book_keeping", 5}};
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
std::optional<Shown> draw_effect(const Strengths& strengths, bool registered, const std::vector<Shown>& there, double s,
                                 Rng& rng) {
  std::vector<const Hidden*> choices;
  for (const Hidden& effect : hidden_effects())
    if (effect.registered == registered &&
        std::none_of(there.begin(), there.end(), [&](const Shown& t) { return t.active.effect == &effect; }))
      choices.push_back(&effect);
  constexpr int kTries = 6;
  for (int i = 0; i < kTries; ++i) {
    const Hidden* effect = choices[rng.below(static_cast<std::uint32_t>(choices.size()))];
    const double sign = rng.uniform() < 0.5 ? -1.0 : 1.0;
    Shown sized = strengths.sized(*effect, s, sign);
    if (sized.s >= 0.7 * kWeakest) return sized;
  }
  return std::nullopt;
}

struct Aliased {
  const char* design;
  std::array<const char*, 2> effects;
};
constexpr std::array kAliased{Aliased{"opaque_only", {"cup_bottom_height", "fill_offset"}},
                              Aliased{"water_one_distance", {"refractive_index", "fill_scale"}}};

/// From all others that are registered. What shows in the spread of repeats alone escapes every sensitivity of a mean.
double escape(const Strengths& strengths, const Shown& hidden) {
  if (hidden.sensitivity.norm() == 0.0) return hidden.s;
  std::vector<const Hidden*> others;
  for (const Hidden& effect : hidden_effects())
    if (effect.registered && &effect != hidden.active.effect) others.push_back(&effect);
  return strengths.escape(hidden.sensitivity, others);
}

/// What the registry's effects imitate, nobody can call unknown: something else is hidden instead. Nor is hidden what
/// passes for the unit's own bias. Coarser steps are not hidden either: heights stay right, and a diagnosis only notes
/// them.
std::vector<Shown> hide_unknown(const Strengths& strengths, Rng& rng, SetTruth& truth) {
  constexpr double kLeastEscape = 4.0;
  constexpr int kTries = 8;
  const bool never_registered = rng.uniform() < 0.6;
  for (int i = 0; i < kTries; ++i) {
    const auto hidden = draw_effect(strengths, !never_registered, {}, 2.0 * draw_strength(rng), rng);
    if (!hidden || shows_in_steps(*hidden->active.effect) || passes_for_the_unit(*hidden->active.effect)) continue;
    truth.escape = escape(strengths, *hidden);
    if (truth.escape < kLeastEscape) continue;
    if (!never_registered) truth.left_out = hidden->active.effect->name;
    return {*hidden};
  }
  truth.escape = 0.0;
  return {};
}

std::vector<Shown> hide_aliased(const Strengths& strengths, const Aliased& aliased, Rng& rng, SetTruth& truth) {
  const Hidden& effect = hidden_effect(aliased.effects[rng.below(2)]);
  const double s = std::max(8.0, draw_strength(rng));
  for (const char* name : aliased.effects) truth.aliased.emplace_back(name);
  return {strengths.sized(effect, s, rng.uniform() < 0.5 ? -1.0 : 1.0)};
}

std::vector<Shown> hide_registered(const Strengths& strengths, int count, Rng& rng) {
  std::vector<Shown> hidden;
  for (int i = 0; i < count; ++i)
    if (auto effect = draw_effect(strengths, true, hidden, draw_strength(rng), rng))
      hidden.push_back(std::move(*effect));
  return hidden;
}

int registered_in(std::string_view kind) { return kind == "single" ? 1 : kind == "pair" ? 2 : 3; }

Eigen::MatrixXd joint_sensitivity(const Strengths& strengths, const std::vector<Shown>& hidden) {
  if (hidden.size() == 1) return hidden.front().sensitivity;
  std::vector<Active> all;
  for (const Shown& effect : hidden) all.push_back(effect.active);
  return strengths.sensitivity(all);
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

SetTruth draw_set(const Views& views, std::uint64_t pack_seed, int number, int sets) {
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
  const Aliased& aliased = kAliased[rng.uniform() < 0.7 ? 0 : 1];
  if (truth.kind == "aliased") truth.design = aliased.design;
  const Design& chosen = design(truth.design);
  const Strengths strengths(chosen, plan(chosen, truth.seed), views);
  const std::vector<Shown> hidden = truth.kind == "unknown" ? hide_unknown(strengths, rng, truth)
                                    : truth.kind == "aliased"
                                        ? hide_aliased(strengths, aliased, rng, truth)
                                        : hide_registered(strengths, registered_in(truth.kind), rng);
  for (const Shown& effect : hidden) truth.effects.push_back({effect.active, effect.s});
  truth.strength_by_liquid = strengths.by_liquid(joint_sensitivity(strengths, hidden));
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
          {"aliased", truth.aliased},
          {"escape", truth.escape},
          {"noise_scale", truth.noise_scale},
          {"heavy_tails", truth.heavy_tails},
          {"strength_by_liquid", by_liquid}};
}

}  // namespace fathom::blind
