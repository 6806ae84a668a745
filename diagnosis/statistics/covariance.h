// The covariance of all observations' errors, and the space in which they are independent and of unit variance.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "diagnosis/statistics/evidence.h"
#include "diagnosis/statistics/variance_components.h"

namespace fathom {

struct Covariance {
  ErrorBudget errors;
  Eigen::VectorXd numerical_variance;  ///< of the predictions
  Eigen::MatrixXd nuisance;            ///< n × nuisances: sensitivities times prior σ; its square is J P Jᵀ
  Eigen::MatrixXd total;
  Eigen::LLT<Eigen::MatrixXd> factor;

  /// L⁻¹ x with total = L Lᵀ: columns of data or sensitivities in units of their error.
  Eigen::MatrixXd whiten(const Eigen::MatrixXd& x) const;
};

/// Of measured minus predicted: repeats, prior nuisances, numerical error, and the variance components that the
/// residual shows.
Covariance estimate_covariance(const Evidence& evidence, const Eigen::VectorXd& residual);

/// The covariance among some of the observations.
Eigen::MatrixXd part(const Covariance& covariance, const std::vector<Eigen::Index>& rows);

/// How well the variance along each whitened column is known, as degrees of freedom (Satterthwaite 1946): that of the
/// variance components and of the priors, each by its share in it.
Eigen::VectorXd degrees_of_freedom(const Covariance& covariance, const Eigen::MatrixXd& columns);

}  // namespace fathom
