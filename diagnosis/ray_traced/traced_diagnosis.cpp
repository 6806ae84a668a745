#include "diagnosis/ray_traced/traced_diagnosis.h"

#include <algorithm>
#include <utility>

#include "core/progress.h"
#include "diagnosis/decision/budget.h"
#include "diagnosis/ray_traced/local_model.h"

namespace fathom {
namespace {

constexpr double kMost_s = 170.0;      // of processor time
constexpr std::size_t kLikeliest = 4;  // explanations that are traced

using Set = std::vector<std::string>;  // of effects

Set named_set(const Diagnosis& diagnosis) {
  Set set;
  for (const NamedEffect& effect : diagnosis.effects) set.push_back(effect.name);
  return set;
}

bool is_unseen(const Candidate& candidate) { return candidate.sensitivity.isZero(0.0); }

/// Whether few rays see something of a set.
bool sees_some(const Evidence& evidence, const Set& set) {
  return std::any_of(evidence.candidates.begin(), evidence.candidates.end(), [&](const Candidate& candidate) {
    return !is_unseen(candidate) && std::find(set.begin(), set.end(), candidate.effect) != set.end();
  });
}

/// Each effect of light in all liquids. Images have all light or none, so the first that few rays do not see at all
/// stands for all of those.
std::vector<Set> light_sets(const Physics& physics) {
  std::vector<Set> sets;
  bool has_unseen = false;
  for (const Candidate& candidate : physics.evidence.candidates) {
    if (!effect_name(candidate.effect).liquid.empty() || !brings_light(*physics.predictor, candidate)) continue;
    if (is_unseen(candidate) && std::exchange(has_unseen, true)) continue;
    sets.push_back({candidate.effect});
  }
  return sets;
}

std::vector<Set> all_sets(const Physics& physics, const Diagnosis& diagnosis) {
  std::vector<Set> sets{named_set(diagnosis)};
  for (Set& set : light_sets(physics)) sets.push_back(std::move(set));
  for (std::size_t i = 0; i < std::min(kLikeliest, diagnosis.ambiguity_set.size()); ++i)
    if (sees_some(physics.evidence, diagnosis.ambiguity_set[i].effects))
      sets.push_back(diagnosis.ambiguity_set[i].effects);
  std::vector<Set> different;
  for (Set& set : sets) {
    std::erase(set, "unknown");
    if (!set.empty() && std::find(different.begin(), different.end(), set) == different.end())
      different.push_back(std::move(set));
  }
  return different;
}

struct TracingPlan {
  std::vector<Set> sets;       ///< the named one first
  std::size_t conditions = 0;  ///< that will be traced, more or less
  std::size_t left_out = 0;    ///< sets that would take too long
};

/// What was named; each effect that lets in light of which few rays know nothing; the likeliest sets of the ambiguity
/// set, of several that cannot be told apart the first; while all takes no more than some minutes of two processors.
TracingPlan plan_tracing(const Physics& physics, const Diagnosis& diagnosis, const RayTracer& tracer) {
  TracingPlan plan;
  RayTracer::Cost total = tracer.cost({});
  for (Set& set : all_sets(physics, diagnosis)) {
    std::vector<EffectValue> typical;
    std::size_t predictions = 1;
    for (const Candidate& candidate : physics.evidence.candidates) {
      if (std::find(set.begin(), set.end(), candidate.effect) == set.end()) continue;
      typical.push_back(typical_departure(candidate));
      if (!is_unseen(candidate)) predictions += 1 + 2 * candidate.parameters.size();  // nearer to the fit, and slopes
    }
    const RayTracer::Cost once = tracer.cost(typical);
    const double seconds = static_cast<double>(predictions) * once.seconds;
    if (set != named_set(diagnosis) && total.seconds + seconds > kMost_s) {
      ++plan.left_out;
      continue;
    }
    total.seconds += seconds;
    total.conditions += predictions * once.conditions;
    plan.sets.push_back(std::move(set));
  }
  plan.conditions = total.conditions;
  return plan;
}

/// Of the effects that were named, at the values that were found.
std::vector<LeftOutLevel> left_out(const RayTracedEvidence& traced, const Diagnosis& diagnosis) {
  std::vector<int> effects;
  std::vector<EffectValue> values;
  for (std::size_t i = 0; i < traced.evidence.candidates.size(); ++i)
    for (const NamedEffect& named : diagnosis.effects) {
      if (named.name != traced.evidence.candidates[i].effect) continue;
      effects.push_back(static_cast<int>(i));
      values.push_back({named.name, {}});
      for (const NamedParameter& parameter : named.parameters) values.back().values.push_back(parameter.value);
    }
  if (effects.empty()) return {};
  const Covariance covariance = estimate_covariance(traced.evidence, measured_minus_predicted(traced.evidence));
  const Problem problem = whitened_problem(traced.evidence, covariance);
  Refit found = weighed(problem, effects, parameters_of(traced.evidence, effects, values),
                        covariance.whiten(traced.predict(values) - traced.evidence.predicted),
                        problem.sensitivities(Eigen::all, columns_of(problem, effects)));
  const Refit fit = with_differences(traced.evidence, traced.predict, covariance, problem, std::move(found));
  return left_out_levels(traced.evidence, linear_fit(covariance, problem, fit));
}

}  // namespace

RayTracedDiagnosis ray_traced_diagnosis(const Physics& physics, const Diagnosis& by_few_rays, const Designs& designs,
                                        const DecisionSettings& settings, bool quiet) {
  std::size_t done = 0, planned = 0;
  Progress progress("ray tracing", 0, quiet);
  RayTracer tracer(physics.predictor, settings.seed, [&] { progress.reach(++done, std::max(done, planned)); });
  const TracingPlan plan = plan_tracing(physics, by_few_rays, tracer);
  planned = plan.conditions;
  const RayTracedEvidence traced = ray_traced_evidence(physics, plan.sets, tracer);
  RayTracedDiagnosis result{.diagnosis = decide(traced.evidence, traced.predict, designs, settings),
                            .observations = traced.evidence.observations,
                            .sets = traced.sets,
                            .left_out = {},
                            .not_seen = traced.not_seen,
                            .not_traced = plan.left_out};
  set_surrogate_differences(traced.evidence, traced.by_few_rays, result.diagnosis.budget);
  result.left_out = left_out(traced, result.diagnosis);
  return result;
}

}  // namespace fathom
