#include "diagnosis/statistics/discovery.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "diagnosis/statistics/distributions.h"

namespace fathom {

double equivalent_z(double chi_squared, Eigen::Index parameters, double dof) {
  if (parameters == 0) return 0.0;
  if (parameters == 1) return normal_score(std::sqrt(std::max(0.0, chi_squared)), dof);
  const double z = normal_quantile(0.5 * chi_squared_tail(chi_squared, static_cast<double>(parameters)));
  return normal_score(std::max(0.0, z), dof);
}

std::vector<CandidateSpace> candidate_spaces(const Problem& problem, const Covariance& covariance) {
  std::vector<CandidateSpace> result;
  for (const auto& columns : problem.columns) {
    CandidateSpace space{orthonormal(problem.signatures(Eigen::all, columns)), 1e4};
    if (space.basis.cols() > 0) space.dof = degrees_of_freedom(covariance, space.basis).minCoeff();
    result.push_back(std::move(space));
  }
  return result;
}

double z_alone(const CandidateSpace& space, const Eigen::VectorXd& residual) {
  return equivalent_z((space.basis.transpose() * residual).squaredNorm(), space.basis.cols(), space.dof);
}

MaximumTail discovery_tail(const std::vector<CandidateSpace>& spaces, const Eigen::MatrixXd& draws) {
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(draws.cols());
  for (const CandidateSpace& space : spaces) {
    const Eigen::VectorXd squares = (space.basis.transpose() * draws).colwise().squaredNorm();
    for (Eigen::Index k = 0; k < draws.cols(); ++k)
      largest[k] = std::max(largest[k], equivalent_z(squares[k], space.basis.cols(), space.dof));
  }
  return fit_maximum(largest);
}

std::vector<EffectSize> sizes_beside_others(const Problem& problem, const Covariance& covariance, const Hypothesis& fit,
                                            const Eigen::MatrixXd& jacobian) {
  Eigen::MatrixXd G = jacobian.transpose() * jacobian;
  G.diagonal() += prior_precisions(fit.parameters);
  const Eigen::MatrixXd inverse = G.llt().solve(Eigen::MatrixXd::Identity(G.rows(), G.cols()));
  // Columns dual to the parameters: each estimate's weights on the data.
  const Eigen::VectorXd dof = degrees_of_freedom(covariance, jacobian * inverse);
  std::vector<EffectSize> result;
  Eigen::Index first = 0;
  for (const int effect : fit.effects) {
    const auto count = static_cast<Eigen::Index>(problem.columns[effect].size());
    const Eigen::VectorXd u = fit.parameters.segment(first, count);
    const double least = dof.segment(first, count).minCoeff();
    result.push_back(
        {equivalent_z(u.dot(inverse.block(first, first, count, count).ldlt().solve(u)), count, least), least});
    first += count;
  }
  return result;
}

}  // namespace fathom
