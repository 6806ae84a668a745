#include "diagnosis/statistics/covariance.h"

#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "diagnosis/statistics/groups.h"
#include "diagnosis/statistics/shared_errors.h"

namespace fathom {

namespace {

/// Nothing is predicted better than this share of the change that the candidates make in an observable.
constexpr double kNumericalFloor = 1e-4;

Eigen::VectorXd numerical_variance(const Evidence& evidence) {
  const auto n = static_cast<Eigen::Index>(evidence.observations.size());
  Eigen::VectorXd change = Eigen::VectorXd::Zero(n);
  for (const Candidate& candidate : evidence.candidates)
    for (Eigen::Index k = 0; k < candidate.sensitivity.cols(); ++k)
      change = change.cwiseMax(candidate.sensitivity.col(k).cwiseAbs() * candidate.parameters[k].prior_scale);
  Eigen::VectorXd variance = Eigen::VectorXd::Zero(n);
  if (evidence.numerical_sd.size() == n) variance = evidence.numerical_sd.cwiseAbs2();
  const Groups observables = group_by(evidence.observations, [](const Observation& o) { return o.observable; });
  for (const auto& rows : observables.members()) {
    const double typical = std::max(change(rows).norm() / std::sqrt(static_cast<double>(rows.size())), 1e-9);
    for (const auto row : rows) variance[row] += std::pow(kNumericalFloor * typical, 2.0);
  }
  return variance;
}

/// Replaces the columns by their solution, on all threads. How they are divided does not depend on the number of these,
/// so rounding does not.
template <class SolveInPlace>
Eigen::MatrixXd solved(Eigen::MatrixXd columns, const SolveInPlace& solve) {
  constexpr Eigen::Index kTogether = 64;
  parallel_items(static_cast<int>((columns.cols() + kTogether - 1) / kTogether), [&](int block) {
    const Eigen::Index first = block * kTogether;
    solve(columns.middleCols(first, std::min(kTogether, columns.cols() - first)));
  });
  return columns;
}

/// Most nuisances are of one pour or placement, and move few observations.
Eigen::SparseMatrix<double> sparse(const Eigen::MatrixXd& nuisances) { return nuisances.sparseView(); }

}  // namespace

Eigen::MatrixXd Covariance::whiten(const Eigen::MatrixXd& x) const {
  return solved(x, [&](auto columns) { factor.matrixL().solveInPlace(columns); });
}

Covariance estimate_covariance(const Evidence& evidence, const Eigen::VectorXd& residual) {
  const auto n = static_cast<Eigen::Index>(evidence.observations.size());
  Covariance covariance;
  covariance.numerical_variance = numerical_variance(evidence);
  covariance.nuisance.resize(n, static_cast<Eigen::Index>(evidence.nuisances.size()));
  for (std::size_t k = 0; k < evidence.nuisances.size(); ++k)
    covariance.nuisance.col(static_cast<Eigen::Index>(k)) =
        evidence.nuisances[k].sigma * evidence.nuisances[k].sensitivity;
  const Eigen::VectorXd repeats = repeat_variances(evidence.observations);
  const Eigen::SparseMatrix<double> nuisance = sparse(covariance.nuisance);
  covariance.total = nuisance * nuisance.transpose();
  covariance.total.diagonal() += repeats + covariance.numerical_variance;
  Eigen::MatrixXd known = covariance.total;
  for (const VarianceComponent& component : expected_shared_errors(evidence)) add(component, known);
  covariance.errors = estimate_errors(evidence, residual, known, repeats);
  const auto add_all = [&](const std::vector<ObservableErrors>& observables) {
    for (const ObservableErrors& errors : observables)
      for (const VarianceComponent& component : errors.components) add(component, covariance.total);
  };
  add_all(covariance.errors.observables);
  const std::vector<ObservableErrors> of_model = estimate_shared_errors(evidence, residual, covariance.total);
  add_all(of_model);
  covariance.errors.observables.insert(covariance.errors.observables.end(), of_model.begin(), of_model.end());
  covariance.factor.compute(covariance.total);
  return covariance;
}

Eigen::MatrixXd part(const Covariance& covariance, const std::vector<Eigen::Index>& rows) {
  return covariance.total(rows, rows);
}

Eigen::VectorXd degrees_of_freedom(const Covariance& covariance, const Eigen::MatrixXd& columns) {
  constexpr double kMost = 1e4;
  if (columns.cols() == 0) return {};  // a matrix without columns has no rows that could be pointed to
  const Eigen::MatrixXd weights = solved(columns, [&](auto some) { covariance.factor.matrixU().solveInPlace(some); });
  const Eigen::VectorXd total = columns.colwise().squaredNorm().transpose().array().max(1e-300);
  const Eigen::VectorXd from_priors = (sparse(covariance.nuisance).transpose() * weights).colwise().squaredNorm();
  // Variance of the variance, relative to its square.
  Eigen::ArrayXd relative = 2.0 / kStatedDof * (from_priors.array() / total.array()).square();
  for (const ObservableErrors& errors : covariance.errors.observables) {
    Eigen::MatrixXd shares(static_cast<Eigen::Index>(errors.components.size()), columns.cols());
    for (std::size_t k = 0; k < errors.components.size(); ++k) {
      const VarianceComponent& component = errors.components[k];
      Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(component.groups.count, columns.cols());
      for (Eigen::Index i = 0; i < weights.rows(); ++i)
        if (const int group = component.groups.of[i]; group >= 0)
          sums.row(group) += component.scale[i] * weights.row(i);
      shares.row(static_cast<Eigen::Index>(k)) = sums.colwise().squaredNorm().array() / total.transpose().array();
    }
    if (shares.rows() > 0)
      relative += shares.cwiseProduct(errors.covariance * shares).colwise().sum().transpose().array();
  }
  return (2.0 / relative.max(2.0 / kMost)).max(3.0).matrix();
}

}  // namespace fathom
