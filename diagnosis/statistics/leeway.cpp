#include "diagnosis/statistics/leeway.h"

#include <algorithm>
#include <cmath>

#include "core/dense.h"

namespace fathom {

Eigen::MatrixXd Leeway::whiten(const Eigen::MatrixXd& x) const {
  if (along.cols() == 0) return x;
  const Eigen::VectorXd less = 1.0 - (1.0 + variance.array()).rsqrt();
  return x - along * (less.asDiagonal() * (along.transpose() * x));
}

Eigen::VectorXd Leeway::share_in(const Eigen::VectorXd& residual) const {
  if (along.cols() == 0) return Eigen::VectorXd::Zero(residual.size());
  const Eigen::VectorXd share = variance.array() / (1.0 + variance.array());
  return along * (share.asDiagonal() * (along.transpose() * residual));
}

Leeway Leeway::at(double amount) const {
  Leeway there = *this;
  if (!grows_from) return there;
  there.variance *= share_of_variance(grows_from, amount);
  there.log_det = there.variance.array().log1p().sum();
  return there;
}

double share_of_variance(std::optional<double> grows_from, double amount) {
  return grows_from ? std::max(0.0, std::abs(amount) - *grows_from) : 1.0;
}

Leeway leeway_of(const Eigen::MatrixXd& errors, std::optional<double> grows_from) {
  constexpr double kNothing = 1e-9;  // of a residual's variance
  Leeway leeway{Eigen::MatrixXd(errors.rows(), 0), {}, grows_from};
  if (errors.cols() == 0) return leeway;
  const SymmetricEigen eigen = symmetric_eigen(errors.transpose() * errors);
  const Eigen::Index count = (eigen.values.array() > kNothing).count();  // they ascend
  leeway.variance = eigen.values.tail(count);
  leeway.along = errors * eigen.vectors.rightCols(count) * leeway.variance.cwiseSqrt().cwiseInverse().asDiagonal();
  leeway.log_det = leeway.variance.array().log1p().sum();
  return leeway;
}

}  // namespace fathom
