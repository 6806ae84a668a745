#include "diagnosis/statistics/decide.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "diagnosis/statistics/budget.h"
#include "diagnosis/statistics/case.h"
#include "diagnosis/statistics/explanations.h"
#include "diagnosis/statistics/gap_size.h"
#include "diagnosis/statistics/hygiene.h"
#include "diagnosis/statistics/intervals.h"
#include "diagnosis/statistics/limits.h"
#include "diagnosis/statistics/once.h"
#include "diagnosis/statistics/options.h"
#include "diagnosis/statistics/sufficiency.h"
#include "diagnosis/statistics/tiers.h"
#include "diagnosis/statistics/unknown.h"
#include "diagnosis/statistics/weigh.h"

namespace fathom {

namespace {

constexpr double kLikelyUnknown = 0.25;

/// Of the likeliest option that has these effects, with something unknown or without.
double log_posterior_with(const std::vector<Option>& options, const std::vector<int>& effects) {
  double best = -INFINITY;
  for (const Option& o : options)
    if (std::includes(o.effects.begin(), o.effects.end(), effects.begin(), effects.end()))
      best = std::max(best, o.log_posterior);
  return best;
}

double log_posterior_of_unknown_alone(const std::vector<Option>& options) {
  for (const Option& o : options)
    if (o.is_unknown_alone()) return o.log_posterior;
  return -INFINITY;
}

/// Whether the likeliest explanation is what passed all tests, with nothing unknown beside it.
bool is_tested(const Weighed& weighed) {
  const Option& best = likeliest(weighed.options);
  return weighed.choice && !best.has_unknown && best.effects == weighed.choice->fit.hypothesis.effects;
}

/// Of what passed all tests. `set` holds, beside the options, what they may imitate.
Verdict verdict_of_named(const Case& c, const Weighed& weighed, const AmbiguitySet& set) {
  const std::vector<int>& effects = weighed.choice->fit.hypothesis.effects;
  if (weighed.is_rest) {
    const bool is_sure = log_posterior_with(weighed.options, effects) >
                         log_posterior_of_unknown_alone(weighed.options) + std::log(kSureOdds);
    return is_sure ? Verdict::named_and_unknown : Verdict::unknown;
  }
  const AmbiguitySet listed = ambiguity_set(weighed.options, kinds_of_candidates(c.evidence), c.settings.delta);
  const bool is_imitation = probability_of_unknown(set) > kLikelyUnknown;
  return all_name(c.evidence, effects, listed) && !is_imitation ? Verdict::named : Verdict::ambiguous;
}

/// Where no test singles out a set of effects.
Verdict verdict_of_unnamed(const Case& c, bool is_rest, const AmbiguitySet& set) {
  if (is_rest || set.classes.front().options.front().has_unknown) return Verdict::unknown;
  if (!c.evidence.mistakes.empty()) return Verdict::named;
  // Some effect may still be needed: then nothing at all is no explanation any more.
  return kSureOdds * probability_of_nothing(set) > 1.0 ? Verdict::none : Verdict::ambiguous;
}

/// What the evidence says before any effect is weighed.
void describe_evidence(const Case& c, Diagnosis& diagnosis) {
  diagnosis.mistakes = c.evidence.mistakes;
  diagnosis.warnings = hygiene_warnings(c.evidence);
  if (!c.covariance.errors.from_replicates)
    diagnosis.warnings.emplace_back(
        "hardly any condition was poured or placed anew: errors are taken from what a smooth model leaves");
  diagnosis.budget = uncertainty_budget(c.evidence, c.covariance);
  diagnosis.confusable = confusable_pairs(c.evidence, c.problem);
  diagnosis.near_null = near_null_directions(c.evidence, c.problem);
  diagnosis.p_gap = c.gap.p;
  diagnosis.where = locate(c.shapes.strata, c.shapes.stratum_columns, c.shapes.stratum_dof, c.problem.residual,
                           c.gap.scan_tail, c.settings.p_confirmation);
}

/// What the weighing left, and what it may still hide.
void describe_rest(const Case& c, const Weighed& weighed, Diagnosis& diagnosis) {
  const Rest& rest = weighed.rest;
  if (diagnosis.verdict == Verdict::unknown || diagnosis.verdict == Verdict::named_and_unknown)
    diagnosis.unknown = describe_unknown(c.evidence, c.covariance, c.problem, c.shapes, rest.residual, rest.explained);
  diagnosis.unknown.p = weighed.p_rest;
  measure_gaps(c, weighed.fit, diagnosis);
  diagnosis.upper_limits = upper_limits(c.evidence, c.problem, weighed.fit.hypothesis.effects, rest.residual,
                                        rest.explained, c.discovery.quantile(c.settings.p_discovery));
}

Diagnosis decide_by(const Evidence& evidence, const Predict& predict, const Designs& designs,
                    const DecisionSettings& settings) {
  Diagnosis diagnosis;
  diagnosis.missing = missing_for_diagnosis(evidence);
  if (!diagnosis.missing.empty()) return diagnosis;
  const Case c = case_of(evidence, predict, settings);
  describe_evidence(c, diagnosis);
  Weighed weighed = weigh(c);
  AmbiguitySet set =
      ambiguity_set(with_imitated(weighed.options, is_tested(weighed)), kinds_of_candidates(evidence), settings.delta);
  if (weighed.is_rest) set.put_unknown_first();
  diagnosis.ambiguity_set = explanations(evidence, set);
  diagnosis.verdict = weighed.choice ? verdict_of_named(c, weighed, set) : verdict_of_unnamed(c, weighed.is_rest, set);
  diagnosis.excess = weighed.rest.excess;
  if (diagnosis.verdict == Verdict::ambiguous)
    diagnosis.lacks_anew = lacks_anew(evidence, c.covariance, set.classes.front().options.front());
  describe_rest(c, weighed, diagnosis);
  if (weighed.choice && diagnosis.verdict != Verdict::unknown) {
    add_parameters(c, *weighed.choice);
    diagnosis.effects = weighed.choice->effects;
    diagnosis.parameter_covariance = covariance_in_units(c, *weighed.choice);
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
