#include "diagnosis/statistics/decide.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "diagnosis/statistics/budget.h"
#include "diagnosis/statistics/case.h"
#include "diagnosis/statistics/choose.h"
#include "diagnosis/statistics/explanations.h"
#include "diagnosis/statistics/gap_size.h"
#include "diagnosis/statistics/hygiene.h"
#include "diagnosis/statistics/intervals.h"
#include "diagnosis/statistics/limits.h"
#include "diagnosis/statistics/options.h"
#include "diagnosis/statistics/sufficiency.h"
#include "diagnosis/statistics/unknown.h"

namespace fathom {

namespace {

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
    if (o.effects.empty() && o.has_unknown) return o.log_posterior;
  return -INFINITY;
}

/// What a test that rejects with p says at most against what it rejects: a bound on the Bayes factor (Sellke, Bayarri &
/// Berger 2001, The American Statistician 55, 62).
double log_bayes_factor(double p) {
  const double log_p = std::log(std::max(p, std::numeric_limits<double>::min()));
  return log_p < -1.0 ? 1.0 + log_p + std::log(-log_p) : 0.0;
}

/// Of what passed all tests.
Verdict verdict_of_named(const Case& c, const Choice& choice, bool is_rest, const std::vector<Option>& options,
                         const AmbiguitySet& listed, bool is_imitated) {
  const std::vector<int>& effects = choice.fit.hypothesis.effects;
  if (!is_rest) return all_name(c.evidence, effects, listed) && !is_imitated ? Verdict::named : Verdict::ambiguous;
  const bool is_sure =
      log_posterior_with(options, effects) > log_posterior_of_unknown_alone(options) + std::log(kSureOdds);
  return is_sure ? Verdict::named_and_unknown : Verdict::unknown;
}

/// Where no test singles out a set of effects.
Verdict verdict_of_unnamed(const Case& c, bool is_rest, const AmbiguitySet& set) {
  if (is_rest || set.classes.front().options.front().has_unknown) return Verdict::unknown;
  if (!c.evidence.mistakes.empty()) return Verdict::named;
  // Some effect may still be needed: then nothing at all is no explanation any more.
  return kSureOdds * probability_of_nothing(set) > 1.0 ? Verdict::none : Verdict::ambiguous;
}

}  // namespace

Diagnosis decide(const Evidence& evidence, const Predict& predict, const Designs& designs,
                 const DecisionSettings& settings) {
  Diagnosis diagnosis;
  diagnosis.missing = missing_for_diagnosis(evidence);
  if (!diagnosis.missing.empty()) return diagnosis;
  diagnosis.mistakes = evidence.mistakes;
  const Case c = case_of(evidence, predict, settings);
  diagnosis.warnings = hygiene_warnings(evidence);
  if (!c.covariance.errors.from_replicates)
    diagnosis.warnings.emplace_back(
        "hardly any condition was measured twice: errors are taken from what a smooth model leaves");
  diagnosis.budget = uncertainty_budget(evidence, c.covariance);
  diagnosis.confusable = confusable_pairs(evidence, c.problem);
  diagnosis.near_null = near_null_directions(evidence, c.problem);
  diagnosis.p_gap = c.gap.p;
  diagnosis.where = locate(c.shapes.strata, c.shapes.stratum_columns, c.shapes.stratum_dof, c.problem.residual,
                           c.gap.scan_tail, settings.p_confirmation);

  const std::vector<Hypothesis> hypotheses = screened(c);
  const std::vector<Refit> fits = likeliest_fits(c, hypotheses);
  std::vector<Option> options = options_of(c, hypotheses, fits);
  const double p_rest_of_likeliest = rest_of(c, fits.front()).p;
  const Refit& nothing =
      *std::find_if(fits.begin(), fits.end(), [](const Refit& f) { return f.hypothesis.effects.empty(); });
  std::optional<Choice> choice = choose(c, fits);
  Rest rest = rest_of(c, choice ? choice->fit : nothing);
  // As long as something stays open, what is small beside the rest is not told from it.
  if (!choice || rest.p < settings.p_gap)
    if (std::optional<Choice> common = common_to_all(c, fits, options, p_rest_of_likeliest < settings.p_gap)) {
      choice = std::move(common);
      rest = rest_of(c, choice->fit);
    }
  // What no test confirms may yet explain the gap: unknown is what the likeliest effects leave, too.
  const double p_rest = std::max(rest.p, p_rest_of_likeliest);
  const bool is_rest = p_rest < settings.p_gap;
  if (choice && is_rest) {
    const std::vector<int> parts = parts_of_rest(c, *choice, rest);
    std::erase_if(options, [&](const Option& o) { return o.has_unknown && holds_any(o.effects, parts); });
    if (!parts.empty()) {
      choice = without(c, *choice, parts);
      rest = rest_of(c, choice ? choice->fit : nothing);
    }
  }
  const Refit& fit = choice ? choice->fit : nothing;

  // Nothing at all is rejected, and so is what moves nothing.
  if (choice) std::erase_if(options, [](const Option& o) { return o.prediction.isZero(0.0) && !o.has_unknown; });
  if (rest.p >= settings.p_gap) std::erase_if(options, [](const Option& o) { return o.has_unknown; });
  if (is_rest)
    for (Option& o : options)
      if (!o.has_unknown) o.log_posterior += log_bayes_factor(p_rest);
  const std::vector<int> kinds = kinds_of_candidates(evidence);
  const AmbiguitySet listed = ambiguity_set(options, kinds, settings.delta),
                     set = ambiguity_set(with_imitated(options), kinds, settings.delta);
  const bool is_imitated = set.classes.front().options.front().has_unknown;
  diagnosis.ambiguity_set = explanations(evidence, set);
  diagnosis.verdict = choice ? verdict_of_named(c, *choice, is_rest, options, listed, is_imitated)
                             : verdict_of_unnamed(c, is_rest, set);
  if (diagnosis.verdict == Verdict::unknown || diagnosis.verdict == Verdict::named_and_unknown)
    diagnosis.unknown = describe_unknown(evidence, c.covariance, c.problem, c.shapes, rest.residual, rest.explained);
  diagnosis.unknown.p = p_rest;

  measure_gaps(c, fit, diagnosis);
  diagnosis.upper_limits = upper_limits(evidence, c.problem, fit.hypothesis.effects, rest.residual, rest.explained,
                                        c.discovery.quantile(settings.p_discovery));
  if (choice && diagnosis.verdict != Verdict::unknown) {
    add_parameters(c, *choice);
    diagnosis.effects = choice->effects;
    diagnosis.parameter_covariance = covariance_in_units(c, *choice);
  }
  if (designs && (diagnosis.verdict == Verdict::ambiguous || diagnosis.verdict == Verdict::none))
    diagnosis.next = next_measurements(evidence, c.covariance, designs, set);
  return diagnosis;
}

}  // namespace fathom
