// What a decision looks at: evidence in units of its errors, and what else than effects may be in it.
#pragma once

#include "diagnosis/statistics/covariance.h"
#include "diagnosis/statistics/decision_settings.h"
#include "diagnosis/statistics/discrepancy.h"
#include "diagnosis/statistics/evidence.h"
#include "diagnosis/statistics/problem.h"
#include "diagnosis/statistics/variance_profile.h"

namespace fathom {

/// All that stays the same while sets of effects are weighed. `evidence`, `predict` and `settings` must outlive it.
struct Case {
  Case(const Evidence& of, const Predict& by, const DecisionSettings& with)
      : evidence(of),
        predict(by),
        settings(with),
        covariance(estimate_covariance(evidence, measured_minus_predicted(evidence))),
        variances(covariance),
        problem(whitened_problem(evidence, covariance)),
        strata(list_strata(evidence.observations)),
        discrepancy(discrepancy_of(evidence, strata, covariance)) {}

  const Evidence& evidence;
  const Predict& predict;
  const DecisionSettings& settings;
  Covariance covariance;
  VarianceProfile variances;
  Problem problem;
  std::vector<Stratum> strata;
  Discrepancy discrepancy;
};

}  // namespace fathom
