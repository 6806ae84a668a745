#include "diagnosis/predict/candidates.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include "core/error.h"
#include "core/progress.h"
#include "diagnosis/statistics/evidence.h"
#include "diagnosis/statistics/groups.h"
#include "sim/effects/registry.h"

namespace fathom {
namespace {

/// Mistakes in writing down are looked for before any physics, with their exact values (bookkeeping.h).
constexpr std::array<std::string_view, 2> kBookkeeping{"unit_error", "label_swap"};

Candidate candidate_of(const Predictor& predictor, const Effect& effect, const std::string& liquid) {
  const std::vector<std::size_t> touched = conditions_touched(predictor, effect, liquid);
  const auto slope_there = [&](const std::function<EffectValue(double)>& at, double low, double high) {
    return slope(
        predictor, [&](double x) { return switch_on({at(x)}); }, low, high, touched);
  };
  return candidate_by_slopes(effect, name_of(EffectName{std::string(effect.id), liquid}), slope_there);
}

std::vector<std::string> poured_liquids(const Predictor& predictor) {
  std::set<std::string> liquids;
  for (const Condition& condition : predictor.conditions())
    if (has_liquid(condition.factors)) liquids.insert(condition.factors.liquid);
  return {liquids.begin(), liquids.end()};
}

/// The part of an effect of liquids that is of one of them.
Candidate candidate_of_liquid(const Predictor& predictor, const Effect& effect, const std::string& liquid,
                              const Candidate& of_all) {
  Candidate candidate = of_all;
  candidate.effect = name_of(EffectName{std::string(effect.id), liquid});
  candidate.sensitivity.setZero();
  for (const std::size_t condition : conditions_touched(predictor, effect, liquid))
    for (const std::size_t row : predictor.conditions()[condition].rows)
      candidate.sensitivity.row(static_cast<Eigen::Index>(row)) =
          of_all.sensitivity.row(static_cast<Eigen::Index>(row));
  return candidate;
}

/// What moves every row by less than this at its prior scale moves nothing that could be measured.
bool moves_anything(const Candidate& candidate) {
  constexpr double kNothing = 1e-4;  // [mm or °]
  double most = 0.0;
  for (std::size_t i = 0; i < candidate.parameters.size(); ++i)
    most = std::max(most, candidate.parameters[i].prior_scale *
                              candidate.sensitivity.col(static_cast<Eigen::Index>(i)).lpNorm<Eigen::Infinity>());
  return most > kNothing;
}

/// Whether an effect in one liquid is all that the effect shows: of one liquid or of all is the same then.
bool shows_only_there(const Candidate& of_liquid, Candidate of_all) {
  of_all.sensitivity -= of_liquid.sensitivity;
  return moves_anything(of_liquid) && !moves_anything(of_all);
}

/// Names of all that a campaign with these liquids could show.
std::vector<std::string> names_of(const Effect& effect, const std::vector<std::string>& liquids) {
  std::vector<std::string> names{std::string(effect.id)};
  if (effect.of_liquids && liquids.size() > 1)
    for (const std::string& liquid : liquids) names.push_back(name_of(EffectName{names.front(), liquid}));
  return names;
}

/// An effect of liquids is as often of one alone as of all; but a laboratory fills all of them with the same hands.
double plausibility_of(const Effect& effect, const std::string& liquid, std::size_t liquids) {
  if (!effect.of_liquids || liquids < 2) return 1.0;
  const double of_one_alone = effect.family == "book-keeping" ? 0.1 : 0.5;
  return liquid.empty() ? 1.0 - of_one_alone : of_one_alone / static_cast<double>(liquids);
}

}  // namespace

Candidate candidate_by_slopes(const Effect& effect, const std::string& name, const Slope& slope) {
  Candidate candidate{.effect = name, .parameters = {}, .sensitivity = {}};
  for (std::size_t i = 0; i < effect.parameters.size(); ++i) {
    const EffectParameter& p = effect.parameters[i];
    candidate.parameters.push_back({std::string(p.name), p.nominal, p.scale, p.lower, p.upper, p.step});
    const auto at = [&](double x) {
      EffectValue value{name, {}};
      for (const EffectParameter& parameter : effect.parameters) value.values.push_back(parameter.nominal);
      value.values[i] = x;
      return value;
    };
    const Eigen::VectorXd column =
        slope(at, std::max(p.nominal - p.scale, p.lower), std::min(p.nominal + p.scale, p.upper));
    candidate.sensitivity.conservativeResize(column.size(), static_cast<Eigen::Index>(i) + 1);
    candidate.sensitivity.col(static_cast<Eigen::Index>(i)) = column;
  }
  return candidate;
}

Candidates candidates_of(const Predictor& predictor, const std::vector<std::string>& only, bool quiet) {
  Candidates candidates;
  const std::vector<std::string> liquids = poured_liquids(predictor);
  std::vector<std::string> names = only;
  if (only.empty())
    for (const Effect& effect : effect_registry()) {
      if (std::find(kBookkeeping.begin(), kBookkeeping.end(), effect.id) != kBookkeeping.end()) continue;
      for (std::string& name : names_of(effect, liquids)) names.push_back(std::move(name));
    }
  std::optional<Candidate> of_all;  // liquids: the last one that was predicted
  Progress progress("effect", names.size(), quiet);
  for (const std::string& name : names) {
    const EffectName parts = effect_name(name);
    const Effect* effect = find_effect(parts.id);
    if (!effect) throw Error("effects", unknown_name("effect", parts.id, effect_ids()));
    Candidate candidate = !parts.liquid.empty() && of_all && of_all->effect == parts.id
                              ? candidate_of_liquid(predictor, *effect, parts.liquid, *of_all)
                              : candidate_of(predictor, *effect, parts.liquid);
    if (parts.liquid.empty()) of_all = candidate;
    candidate.plausibility = plausibility_of(*effect, parts.liquid, liquids.size());
    if (only.empty() && !parts.liquid.empty() && shows_only_there(candidate, *of_all)) {
      candidates.all.back().plausibility += candidate.plausibility;
      progress.step();
      continue;
    }
    const bool is_seen = moves_anything(candidate);
    if (!is_seen) candidate.sensitivity.setZero();
    if (!is_seen && parts.liquid.empty()) candidates.unseen.push_back(parts.id);
    if (is_seen || (only.empty() && parts.liquid.empty())) candidates.all.push_back(std::move(candidate));
    progress.step();
  }
  return candidates;
}

}  // namespace fathom
