// A set of effects fitted to the data with the model itself, not with its sensitivities.
#pragma once

#include "diagnosis/statistics/covariance.h"
#include "diagnosis/statistics/evidence.h"
#include "diagnosis/statistics/problem.h"

namespace fathom {

struct Refit {
  Hypothesis hypothesis;
  Eigen::VectorXd prediction;  ///< change against the nominal model, whitened, with the likeliest of its leeway
  Eigen::VectorXd change;      ///< the same without
  Eigen::VectorXd rest;        ///< what it leaves, in units of errors and leeway together
  Eigen::MatrixXd jacobian;    ///< of it, whitened, n × parameters in prior scales
};

/// Levenberg and Marquardt's method within the bounds, from the linear solution; nuisances are free within their priors
/// because the covariance holds them. The Jacobian starts as the sensitivities and learns from every step (Broyden
/// 1965); where that fails it is differenced once. Ceres would difference it at every step, and a prediction is what
/// costs.
Refit refit(const Evidence& evidence, const Predict& predict, const Covariance& covariance, const Problem& problem,
            const Hypothesis& start);

/// What effects are worth that change the prediction by `change`, whitened, beside the leeway that they have there.
Refit weighed(const Problem& problem, const std::vector<int>& effects, const Eigen::VectorXd& parameters,
              Eigen::VectorXd change, Eigen::MatrixXd jacobian);

/// The same as `refit`, with the Jacobian differenced at the solution: for intervals.
Refit with_differences(const Evidence& evidence, const Predict& predict, const Covariance& covariance,
                       const Problem& problem, Refit fit);

}  // namespace fathom
