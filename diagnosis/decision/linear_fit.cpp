#include "diagnosis/decision/linear_fit.h"

namespace fathom {

LinearFit linear_fit(const Covariance& covariance, const Problem& problem, const Refit& fit) {
  const auto unwhitened = [&](const Eigen::MatrixXd& x) -> Eigen::MatrixXd {
    if (x.cols() == 0) return x;  // Eigen's product would look at its first number
    return covariance.factor.matrixL() * x;
  };
  LinearFit linear{covariance, {}, {}, {}, {}};
  const Leeway leeway = leeway_beside(problem, fit.hypothesis.effects, fit.hypothesis.parameters);
  if (leeway.along.cols() > 0) {
    const Eigen::MatrixXd own = unwhitened(leeway.along * leeway.variance.cwiseSqrt().asDiagonal());
    linear.covariance.total += own * own.transpose();
    linear.covariance.factor.compute(linear.covariance.total);
  }
  linear.jacobian = unwhitened(fit.jacobian);
  linear.residual = unwhitened(problem.residual - fit.change + fit.jacobian * fit.hypothesis.parameters);
  linear.prior = prior_precisions(fit.hypothesis.parameters);
  Eigen::Index first = 0;
  for (const int effect : fit.hypothesis.effects) {
    linear.columns.emplace_back();
    for (std::size_t k = 0; k < problem.columns[effect].size(); ++k) linear.columns.back().push_back(first++);
  }
  return linear;
}

}  // namespace fathom
