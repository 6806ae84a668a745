#include "diagnosis/ray_traced/traced_diagnosis.h"

#include <algorithm>

#include "core/progress.h"
#include "diagnosis/decision/budget.h"
#include "diagnosis/ray_traced/local_model.h"
#include "diagnosis/ray_traced/tracing_plan.h"

namespace fathom {
namespace {

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
