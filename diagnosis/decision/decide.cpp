#include "diagnosis/decision/decide.h"

#include <cmath>
#include <optional>

#include "core/dense.h"
#include "diagnosis/decision/budget.h"
#include "diagnosis/decision/excess.h"
#include "diagnosis/decision/explanations.h"
#include "diagnosis/decision/gap_size.h"
#include "diagnosis/decision/hygiene.h"
#include "diagnosis/decision/intervals.h"
#include "diagnosis/decision/limits.h"
#include "diagnosis/decision/locate.h"
#include "diagnosis/decision/sufficiency.h"
#include "diagnosis/decision/tiers.h"
#include "diagnosis/decision/unknown.h"
#include "diagnosis/statistics/case.h"
#include "diagnosis/statistics/posterior.h"
#include "diagnosis/statistics/problem.h"

namespace fathom {

namespace {

/// What the evidence says before any effect is weighed.
void describe_evidence(const Case& c, Diagnosis& diagnosis) {
  diagnosis.data.mistakes = c.evidence.mistakes;
  diagnosis.data.warnings = hygiene_warnings(c.evidence);
  if (!c.covariance.errors.from_replicates)
    diagnosis.data.warnings.emplace_back(
        "Fewer than eight heights repeat a condition with a new pour or placement, so errors are taken from what a "
        "smooth curve through the conditions leaves. Repeat more of them.");
  diagnosis.budget = uncertainty_budget(c.evidence, c.covariance);
  diagnosis.limits.confusable = confusable_pairs(c.evidence, c.problem);
  diagnosis.limits.near_null = near_null_directions(c.evidence, c.problem);
}

/// Where measured and predicted differ, the liquids among it in which the explanation that was fitted shows.
std::vector<GapLocation> locations_of(const Case& c, const Refit& fit) {
  const double level = c.settings.p_where;
  const Eigen::MatrixXd columns = stratum_columns(c.strata, c.covariance);
  std::vector<GapLocation> locations = locate(c.strata, columns, degrees_of_freedom(c.covariance, columns),
                                              c.problem.residual, level, liquids_with(c, fit.prediction, level));
  const Eigen::VectorXd departures = measured_minus_predicted(c.evidence);
  for (GapLocation& where : locations)
    for (const Stratum& stratum : c.strata)
      if (stratum.observable == where.observable && stratum.name == where.stratum)
        where.departure = departures(stratum.rows).mean();
  return locations;
}

/// The likeliest option's effects that are surely there, fitted by themselves; nothing where there are none.
std::optional<Refit> sure_fit(const Case& c, const Posterior& posterior, const std::vector<int>& kinds) {
  const Option& best = likeliest(posterior.options);
  std::vector<std::size_t> sure;
  for (std::size_t e = 0; e < best.effects.size(); ++e)
    if (probability_of(best.effects[e], posterior.options, kinds) > kSure) sure.push_back(e);
  if (sure.empty()) return std::nullopt;
  const Hypothesis part = part_of(c.problem, {best.effects, best.parameters}, sure);
  const Refit* known = find_fit(posterior.fits, part.effects);
  const Refit fit = known ? *known : refit(c.evidence, c.predict, c.covariance, c.problem, part);
  return with_differences(c.evidence, c.predict, c.covariance, c.problem, fit);
}

/// The fit of what stands first in the set; of no effects, where that has no fit.
Refit first_fit(const Case& c, const Posterior& posterior, const AmbiguitySet& set) {
  for (const Option& option : set.classes.front().options)
    if (const Refit* fit = find_fit(posterior.fits, option.effects))
      return with_differences(c.evidence, c.predict, c.covariance, c.problem, *fit);
  return *find_fit(posterior.fits, {});
}

/// What effects leave of the residual, with whatever changes of their parameters would make taken out.
struct Rest {
  Eigen::VectorXd residual;   ///< whitened
  Eigen::MatrixXd explained;  ///< orthonormal
};

Rest rest_of(const Case& c, const Refit& fit) {
  Rest rest{c.problem.residual - fit.prediction, orthonormal(fit.jacobian)};
  rest.residual = without(rest.residual, rest.explained);
  return rest;
}

/// Whether something is there that no effect explains. Where an effect surely is, whichever, it takes the odds of an
/// alarm.
bool needs_unknown(const Shares& shares) {
  return shares.effects > kSure ? (1.0 - shares.unknown) * kAlarmOdds < shares.unknown : shares.unknown > 0.5;
}

Verdict verdict_of(const Case& c, const AmbiguitySet& set, const std::vector<int>& kinds, const Shares& shares,
                   bool is_excess, bool is_unknown, bool names_all, bool names_any) {
  const Verdict with_unknown = names_any ? Verdict::named_and_unknown : Verdict::unknown;
  if (is_excess) return with_unknown;
  if (shares.nothing > 1.0 - kSure) return c.evidence.mistakes.empty() ? Verdict::none : Verdict::named;
  if (kAlarmOdds * shares.nothing > 1.0) return Verdict::ambiguous;
  if (is_unknown) return with_unknown;
  const AmbiguityClass& first = set.classes.front();
  const bool is_one = first.probability > kSure && is_one_explanation(first, kinds);
  return names_all && is_one ? Verdict::named : Verdict::ambiguous;
}

Diagnosis decide_by(const Evidence& evidence, const Predict& predict, const Designs& designs,
                    const DecisionSettings& settings) {
  Diagnosis diagnosis;
  diagnosis.data.missing = missing_for_diagnosis(evidence);
  if (!diagnosis.data.missing.empty()) return diagnosis;
  const Case c(evidence, predict, settings);
  describe_evidence(c, diagnosis);
  Posterior posterior = posterior_of(c);
  const std::vector<int> kinds = kinds_of_candidates(evidence);
  Shares shares = shares_of(posterior.options);
  const std::optional<Refit> sure = sure_fit(c, posterior, kinds);
  std::vector<double> sure_probabilities;
  for (const int effect : sure ? sure->hypothesis.effects : std::vector<int>{})
    sure_probabilities.push_back(probability_of(effect, posterior.options, kinds));
  const bool is_unknown = needs_unknown(shares);
  AmbiguitySet set = ambiguity_set(posterior.options, kinds, settings.delta, is_unknown ? 0.0 : std::log(kAlarmOdds));
  const Refit& fit = sure ? *sure : *find_fit(posterior.fits, {});
  const Rest rest = rest_of(c, fit);
  // What the likeliest explanation makes of sessions is no excess, even if others could stand for it.
  const Rest likely = rest_of(c, first_fit(c, posterior, set));
  diagnosis.departures.excess = excess_of(evidence, c.covariance, likely.residual, likely.explained, settings.p_excess);
  const bool is_excess = !diagnosis.departures.excess.empty();
  const bool names_all = sure && sure->hypothesis.effects == likeliest(posterior.options).effects;
  diagnosis.verdict = verdict_of(c, set, kinds, shares, is_excess, is_unknown, names_all, sure.has_value());
  if (is_excess) {
    const auto least = std::ranges::min_element(diagnosis.departures.excess, {}, &Excess::p);
    weigh_failed_check(least->p, posterior.options);
    shares = shares_of(posterior.options);
    set = ambiguity_set(posterior.options, kinds, settings.delta);
    set.put_unknown_first();
  }
  diagnosis.ambiguity_set = explanations(c, posterior, set, kinds);
  diagnosis.probability_of_none = shares.nothing;
  diagnosis.probability_of_unknown = shares.unknown;
  if (diagnosis.verdict == Verdict::unknown || diagnosis.verdict == Verdict::named_and_unknown)
    diagnosis.unknown =
        describe_unknown(evidence, c.covariance, c.problem, c.discrepancy, rest.residual, rest.explained);
  // Where several explanations are left a reader wants to see what the likeliest makes of the differences.
  const Refit shown = diagnosis.verdict == Verdict::ambiguous && !sure ? first_fit(c, posterior, set) : fit;
  measure_gaps(c, shown, diagnosis);
  diagnosis.departures.where = locations_of(c, shown);
  diagnosis.limits.upper = upper_limits(evidence, c.problem, fit.hypothesis.effects, rest.residual, rest.explained);
  diagnosis.limits.size_errors = size_errors(evidence, c.problem);
  if (sure) {
    diagnosis.effects = named_effects(c, *sure);
    for (std::size_t e = 0; e < diagnosis.effects.size(); ++e) diagnosis.effects[e].probability = sure_probabilities[e];
    diagnosis.parameter_covariance = covariance_in_units(c, *sure);
  }
  if (designs && (diagnosis.verdict == Verdict::ambiguous || diagnosis.verdict == Verdict::none))
    diagnosis.next = next_measurements(evidence, c.covariance, designs, set);
  return diagnosis;
}

}  // namespace

Diagnosis decide(const Evidence& evidence, const Predict& predict, const Designs& designs,
                 const DecisionSettings& settings) {
  Diagnosis by_all = decide_by(evidence, predict, designs, settings);
  const std::vector<Eigen::Index> deciding = deciding_rows(evidence);
  const bool is_settled = by_all.verdict == Verdict::none || by_all.verdict == Verdict::named ||
                          by_all.verdict == Verdict::insufficient || deciding.size() == evidence.observations.size();
  if (is_settled) return by_all;
  Diagnosis by_deciding =
      decide_by(deciding_evidence(evidence, deciding), predict_rows(predict, deciding), designs, settings);
  return joined_tiers(std::move(by_all), std::move(by_deciding), evidence, deciding);
}

}  // namespace fathom
