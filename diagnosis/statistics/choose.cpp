#include "diagnosis/statistics/choose.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/statistics/confirm.h"
#include "diagnosis/statistics/effect_name.h"

namespace fathom {

namespace {

constexpr int kConfirmationDraws = 300;
constexpr double kNearlyAll = 0.9;  // of the gap's squares

/// Whether some main stratum becomes significantly worse, by more than its u_val.
bool worsens(const Case& c, const Refit& fit) {
  for (std::size_t k = 0; k < c.shapes.strata.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    const Eigen::VectorXd direction = c.shapes.stratum_columns.col(column).normalized();
    const double before = std::abs(direction.dot(c.problem.residual));
    const double after = std::abs(direction.dot(c.problem.residual - fit.prediction));
    const double p_after = c.gap.scan_tail.p(normal_score(after, c.shapes.stratum_dof[column]));
    if (c.shapes.strata[k].is_main && after > before + 1.0 && p_after < c.settings.p_gap) return true;
  }
  return false;
}

/// The effects of a fit with their evidence; none of those that do not pass all tests.
std::vector<std::optional<NamedEffect>> tested(const Case& c, const Refit& fit) {
  const std::vector<EffectSize> sizes = sizes_beside_others(c.problem, c.covariance, fit.hypothesis, fit.jacobian);
  // A set of which no effect shows alone was one of many sets, not of many effects.
  const double sets = static_cast<double>(c.problem.columns.size());
  bool shows_alone = false;
  for (const int effect : fit.hypothesis.effects)
    shows_alone |= c.discovery.p(z_alone(c.spaces[effect], c.problem.residual)) < c.settings.p_discovery;
  std::vector<NamedEffect> effects(sizes.size());
  std::vector<double> dof;
  for (std::size_t e = 0; e < sizes.size(); ++e) {
    effects[e].name = c.evidence.candidates[fit.hypothesis.effects[e]].effect;
    effects[e].p_discovery = std::min(1.0, c.discovery.p(sizes[e].z) * (shows_alone ? 1.0 : sets));
    dof.push_back(sizes[e].dof);
  }
  std::vector<std::optional<NamedEffect>> passed(sizes.size());
  const auto is_discovered = [&](const NamedEffect& effect) { return effect.p_discovery < c.settings.p_discovery; };
  if (std::none_of(effects.begin(), effects.end(), is_discovered)) return passed;
  const Eigen::MatrixXd draws = c.covariance.factor.matrixL() *
                                c.draws.all.leftCols(std::min<Eigen::Index>(kConfirmationDraws, c.draws.all.cols()));
  const std::vector<Confirmation> confirmations = confirm(
      c.evidence.observations, c.covariance, linear_fit(c.covariance, c.problem, fit), draws, dof, c.settings.seed);
  for (std::size_t e = 0; e < sizes.size(); ++e) {
    const Confirmation& confirmation = confirmations[e];
    effects[e].p_confirmation = confirmation.p;
    effects[e].p_sign_flip = confirmation.p_sign_flip;
    effects[e].folds = confirmation.folds_informative;
    effects[e].folds_improved = confirmation.folds_improved;
    const int against = confirmation.folds_informative - confirmation.folds_improved;
    if (is_discovered(effects[e]) && confirmation.p < c.settings.p_confirmation && against <= 1) passed[e] = effects[e];
  }
  return passed;
}

/// The effects of a fit with their evidence, if all of them pass all tests.
std::optional<std::vector<NamedEffect>> verified(const Case& c, const Refit& fit) {
  std::vector<NamedEffect> effects;
  for (std::optional<NamedEffect>& effect : tested(c, fit)) {
    if (!effect) return std::nullopt;
    effects.push_back(std::move(*effect));
  }
  if (worsens(c, fit)) return std::nullopt;
  return effects;
}

bool is_part(const Refit& part, const Refit& whole) {
  const std::vector<int>&few = part.hypothesis.effects, &all = whole.hypothesis.effects;
  return std::includes(all.begin(), all.end(), few.begin(), few.end());
}

/// Whether more effects, not much less likely, take so much more from the residual that each may be discovered.
bool adds_enough(const Case& c, const Refit& more, const Refit& fit) {
  const double least = std::pow(c.discovery.quantile(c.settings.p_discovery), 2);
  const auto added = static_cast<double>(more.hypothesis.effects.size() - fit.hypothesis.effects.size());
  return more.hypothesis.log_evidence > fit.hypothesis.log_evidence - c.settings.delta &&
         more.hypothesis.gain > fit.hypothesis.gain + added * least;
}

/// Whether every option that is not excluded has this effect, in whatever liquid.
bool all_have(const Case& c, const std::vector<Option>& options, int effect) {
  const auto id_of = [&](int candidate) { return effect_name(c.evidence.candidates[candidate].effect).id; };
  const double best = likeliest(options).log_posterior;
  return std::all_of(options.begin(), options.end(), [&](const Option& o) {
    return o.log_posterior < best - c.settings.delta ||
           std::any_of(o.effects.begin(), o.effects.end(), [&](int one) { return id_of(one) == id_of(effect); });
  });
}

/// Squared z of the stratum in which most is left.
double most_left(const Case& c, const Rest& rest) {
  const Eigen::MatrixXd& columns = c.shapes.stratum_columns;
  double most = 0.0;
  for (const SignificantStratum& one :
       significant_strata(columns - rest.explained * (rest.explained.transpose() * columns), c.shapes.stratum_dof,
                          rest.residual, c.gap.scan_tail, c.settings.p_gap))
    most = std::max(most, one.z * one.z);
  return most;
}

}  // namespace

std::optional<Choice> choose(const Case& c, const std::vector<Refit>& fits) {
  const auto first = std::find_if(fits.begin(), fits.end(), [](const Refit& f) { return f.hypothesis.effects.size(); });
  if (first == fits.end()) return std::nullopt;
  std::vector<const Refit*> nested;  // largest sets first
  for (const Refit& fit : fits)
    if (is_part(fit, *first) || (is_part(*first, fit) && adds_enough(c, fit, *first))) nested.push_back(&fit);
  std::stable_sort(nested.begin(), nested.end(), [](const Refit* a, const Refit* b) {
    return a->hypothesis.effects.size() > b->hypothesis.effects.size();
  });
  for (const Refit* fit : nested) {
    if (fit->hypothesis.effects.empty() || fit->hypothesis.log_evidence < std::log(kSureOdds)) continue;
    if (auto effects = verified(c, with_chords(c.evidence, c.predict, c.covariance, c.problem, *fit)))
      return Choice{with_differences(c.evidence, c.predict, c.covariance, c.problem, *fit), std::move(*effects)};
  }
  return std::nullopt;
}

std::optional<Choice> common_to_all(const Case& c, const std::vector<Refit>& fits, const std::vector<Option>& options,
                                    bool is_open) {
  const Refit first = with_chords(c.evidence, c.predict, c.covariance, c.problem, fits.front());
  const std::vector<int>& effects = first.hypothesis.effects;
  if (effects.empty()) return std::nullopt;
  const std::vector<std::optional<NamedEffect>> passed = tested(c, first);
  std::vector<std::pair<double, std::size_t>> common;  // how much each changes, whitened; its position
  Eigen::Index column = 0;
  for (std::size_t e = 0; e < effects.size(); ++e) {
    const auto count = static_cast<Eigen::Index>(c.problem.columns[effects[e]].size());
    const double change =
        (first.jacobian.middleCols(column, count) * first.hypothesis.parameters.segment(column, count)).norm();
    if (passed[e] && all_have(c, options, effects[e])) common.emplace_back(change, e);
    column += count;
  }
  std::sort(common.rbegin(), common.rend());
  const double gap = c.problem.residual.squaredNorm() - static_cast<double>(c.problem.residual.size());
  std::vector<std::size_t> positions;
  for (const auto& [change, position] : common) {
    positions.insert(std::upper_bound(positions.begin(), positions.end(), position), position);
    if (positions.size() == effects.size() && !is_open) return std::nullopt;  // it was not chosen
    const Refit fit =
        refit(c.evidence, c.predict, c.covariance, c.problem, part_of(c.problem, first.hypothesis, positions));
    if (fit.hypothesis.gain < kNearlyAll * gap) continue;
    Choice choice{with_differences(c.evidence, c.predict, c.covariance, c.problem, fit), {}};
    for (const std::size_t e : positions) choice.effects.push_back(*passed[e]);
    return choice;
  }
  return std::nullopt;
}

std::vector<int> parts_of_rest(const Case& c, const Choice& choice, const Rest& rest) {
  constexpr double kShare = 1.0 / 3.0;  // of its square: hardly ever more, if it is any of some ten directions
  const Hypothesis& h = choice.fit.hypothesis;
  const double left = most_left(c, rest);
  std::vector<int> parts;
  Eigen::Index first = 0;
  for (const int effect : h.effects) {
    const auto count = static_cast<Eigen::Index>(c.problem.columns[effect].size());
    Eigen::MatrixXd others = choice.fit.jacobian;
    others.middleCols(first, count).setZero();
    const Eigen::MatrixXd span = orthonormal(others);
    const Eigen::VectorXd change = choice.fit.jacobian.middleCols(first, count) * h.parameters.segment(first, count);
    const double own = (change - span * (span.transpose() * change)).squaredNorm();
    if (own < kShare * (own + left)) parts.push_back(effect);
    first += count;
  }
  return parts;
}

std::optional<Choice> without(const Case& c, const Choice& choice, const std::vector<int>& left_out) {
  std::vector<std::size_t> positions;
  Choice rest;
  for (std::size_t e = 0; e < choice.effects.size(); ++e)
    if (std::find(left_out.begin(), left_out.end(), choice.fit.hypothesis.effects[e]) == left_out.end()) {
      positions.push_back(e);
      rest.effects.push_back(choice.effects[e]);
    }
  if (positions.empty()) return std::nullopt;
  const Refit fit =
      refit(c.evidence, c.predict, c.covariance, c.problem, part_of(c.problem, choice.fit.hypothesis, positions));
  rest.fit = with_differences(c.evidence, c.predict, c.covariance, c.problem, fit);
  return rest;
}

}  // namespace fathom
