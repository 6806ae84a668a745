#include "diagnosis/statistics/discovery.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "diagnosis/statistics/distributions.h"

namespace fathom {

double equivalent_z(double chi_squared, Eigen::Index parameters) {
  if (parameters == 1) return std::sqrt(std::max(0.0, chi_squared));
  return std::max(0.0, normal_quantile(0.5 * chi_squared_tail(chi_squared, static_cast<double>(parameters))));
}

MaximumTail discovery_tail(const Problem& problem, const Eigen::MatrixXd& draws) {
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(draws.cols());
  for (const auto& columns : problem.columns) {
    const Eigen::MatrixXd basis = orthonormal(problem.signatures(Eigen::all, columns));
    if (basis.cols() == 0) continue;
    const Eigen::VectorXd squares = (basis.transpose() * draws).colwise().squaredNorm();
    for (Eigen::Index k = 0; k < draws.cols(); ++k)
      largest[k] = std::max(largest[k], equivalent_z(squares[k], basis.cols()));
  }
  return fit_maximum(largest);
}

std::vector<double> z_beside_others(const Problem& problem, const Hypothesis& fit, const Eigen::MatrixXd& jacobian) {
  Eigen::MatrixXd G = jacobian.transpose() * jacobian;
  G.diagonal().array() += 1.0 / (kPriorWidth * kPriorWidth);
  const Eigen::MatrixXd covariance = G.llt().solve(Eigen::MatrixXd::Identity(G.rows(), G.cols()));
  std::vector<double> result;
  Eigen::Index first = 0;
  for (const int effect : fit.effects) {
    const auto count = static_cast<Eigen::Index>(problem.columns[effect].size());
    const Eigen::VectorXd u = fit.parameters.segment(first, count);
    result.push_back(equivalent_z(u.dot(covariance.block(first, first, count, count).ldlt().solve(u)), count));
    first += count;
  }
  return result;
}

}  // namespace fathom
