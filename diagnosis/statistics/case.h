// What a decision looks at: evidence in units of its errors, pseudo-experiments, and the shapes that are tested.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnosis/statistics/covariance.h"
#include "diagnosis/statistics/decision_settings.h"
#include "diagnosis/statistics/discovery.h"
#include "diagnosis/statistics/evidence.h"
#include "diagnosis/statistics/gap_test.h"
#include "diagnosis/statistics/problem.h"
#include "diagnosis/statistics/refit.h"

namespace fathom {

/// All that stays the same while sets of effects are weighed.
struct Case {
  const Evidence& evidence;
  const Predict& predict;
  const DecisionSettings& settings;
  Covariance covariance;
  Problem problem;
  GapShapes shapes;
  GapDraws draws;
  std::vector<CandidateSpace> spaces;
  MaximumTail discovery;  ///< of the largest effect
  GapTest gap;            ///< of the residual itself
};

/// `evidence`, `predict` and `settings` must outlive the result.
Case case_of(const Evidence& evidence, const Predict& predict, const DecisionSettings& settings);

/// What is left of the residual where a fit, and any change of its parameters, is taken out.
struct Rest {
  Eigen::VectorXd residual;    ///< whitened
  Eigen::MatrixXd explained;   ///< orthonormal directions that were taken out
  std::vector<Excess> excess;  ///< of sessions, pours, placements and trials
  double p = 1.0;              ///< that errors alone leave as much
};
Rest rest_of(const Case& c, const Refit& fit);

}  // namespace fathom
