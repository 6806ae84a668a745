// How large random errors are that stand in groups of the data: restricted maximum likelihood.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace fathom {

/// What is known of a variance beforehand: as if it had been found in a trial with so many degrees of freedom.
struct VariancePrior {
  double variance = 0.0, dof = 0.0;  ///< 0: nothing is known
};

struct VarianceFit {
  Eigen::VectorXd variances;
  Eigen::MatrixXd covariance;  ///< of these estimates
};

/// Log of the restricted likelihood, up to a constant, of contrasts with the covariance known + Σ variance · shape.
double restricted_log_likelihood(const Eigen::VectorXd& contrasts, const Eigen::MatrixXd& known,
                                 const std::vector<Eigen::MatrixXd>& shapes, const Eigen::VectorXd& variances);

/// Patterson & Thompson (1971), by Fisher scoring from `start`: `contrasts` of the data, which hold errors alone, have
/// the covariance known + Σ variance · shape. Variances stay at 0 or above; those with a prior are modes of the
/// posterior.
VarianceFit fit_variances(const Eigen::VectorXd& contrasts, const Eigen::MatrixXd& known,
                          const std::vector<Eigen::MatrixXd>& shapes, const std::vector<VariancePrior>& priors);

}  // namespace fathom
