// A set of effects at its fit, as the linear model that tests and held-out predictions work on.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnosis/statistics/refit.h"

namespace fathom {

/// Observations linearised at the fit, not whitened: residual ≈ jacobian · parameters + errors.
struct LinearFit {
  Covariance covariance;  ///< of errors, and of what comes with the effects and nobody predicts
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;                        ///< per prior scale
  Eigen::VectorXd prior;                           ///< precision of each parameter
  std::vector<std::vector<Eigen::Index>> columns;  ///< of each effect
};

LinearFit linear_fit(const Covariance& covariance, const Problem& problem, const Refit& fit);

}  // namespace fathom
