#include "diagnosis/statistics/covariance.h"

#include <algorithm>
#include <cmath>

#include "core/rng.h"
#include "diagnosis/statistics/groups.h"

namespace fathom {

namespace {

/// Nothing is predicted better than this share of the change that the candidates make in an observable.
constexpr double kNumericalFloor = 1e-4;
/// Stated σ are estimates themselves: as if each came from 20 trials (they are wrong by a sixth).
constexpr double kPriorDof = 20.0;

Eigen::VectorXd numerical_variance(const Evidence& evidence) {
  const auto n = static_cast<Eigen::Index>(evidence.observations.size());
  Eigen::VectorXd change = Eigen::VectorXd::Zero(n);
  for (const Candidate& candidate : evidence.candidates)
    for (Eigen::Index k = 0; k < candidate.signature.cols(); ++k)
      change = change.cwiseMax(candidate.signature.col(k).cwiseAbs() * candidate.parameters[k].prior_scale);
  Eigen::VectorXd variance = Eigen::VectorXd::Zero(n);
  if (evidence.numerical_sd.size() == n) variance = evidence.numerical_sd.cwiseAbs2();
  const Groups observables = group_by(evidence.observations, [](const Observation& o) { return o.observable; });
  for (const auto& rows : observables.members()) {
    const double typical = std::max(change(rows).norm() / std::sqrt(static_cast<double>(rows.size())), 1e-9);
    for (const auto row : rows) variance[row] += std::pow(kNumericalFloor * typical, 2.0);
  }
  return variance;
}

void add(const VarianceComponent& component, Eigen::MatrixXd& covariance) {
  for (const auto& members : component.groups.members())
    for (const auto i : members)
      for (const auto j : members) covariance(i, j) += component.variance;
}

/// A variance that the data might as well have come from: scaled inverse χ² where it is known to a few degrees of
/// freedom, half a normal where it is hardly above 0.
double redrawn(const VarianceComponent& component, Rng& rng) {
  const double dof = 2.0 * std::pow(component.variance / std::max(component.standard_error, 1e-300), 2.0);
  if (dof > 4.0) return component.variance * dof / rng.gamma(0.5 * dof, 2.0);
  return std::max(0.0, component.variance + component.standard_error * rng.normal());
}

}  // namespace

Covariance estimate_covariance(const Evidence& evidence, const Eigen::VectorXd& residual) {
  const auto n = static_cast<Eigen::Index>(evidence.observations.size());
  Covariance covariance;
  covariance.numerical_variance = numerical_variance(evidence);
  covariance.nuisance.resize(n, static_cast<Eigen::Index>(evidence.nuisances.size()));
  for (std::size_t k = 0; k < evidence.nuisances.size(); ++k)
    covariance.nuisance.col(static_cast<Eigen::Index>(k)) =
        evidence.nuisances[k].sigma * evidence.nuisances[k].signature;
  const Eigen::VectorXd repeats = repeat_variances(evidence.observations);
  covariance.total = covariance.nuisance * covariance.nuisance.transpose();
  covariance.total.diagonal() += repeats + covariance.numerical_variance;
  covariance.errors = estimate_errors(evidence, residual, covariance.total, repeats);
  for (const VarianceComponent& component : covariance.errors.components) add(component, covariance.total);
  covariance.factor.compute(covariance.total);
  return covariance;
}

Eigen::MatrixXd part(const Covariance& covariance, const std::vector<Eigen::Index>& rows) {
  return covariance.total(rows, rows);
}

Eigen::MatrixXd pseudo_experiments(const Covariance& covariance, int draws, std::uint64_t seed) {
  const Eigen::Index n = covariance.total.rows();
  const Eigen::VectorXd independent = (covariance.errors.repeat_variance + covariance.numerical_variance).cwiseSqrt();
  Eigen::MatrixXd nuisances(covariance.nuisance.cols(), draws);
  Eigen::MatrixXd residuals(n, draws);
  for (int draw = 0; draw < draws; ++draw) {
    Rng rng(seed, draw);
    const double prior_scale = std::sqrt(kPriorDof / rng.gamma(0.5 * kPriorDof, 2.0));
    for (Eigen::Index k = 0; k < nuisances.rows(); ++k) nuisances(k, draw) = prior_scale * rng.normal();
    for (Eigen::Index i = 0; i < n; ++i) residuals(i, draw) = independent[i] * rng.normal();
    for (const VarianceComponent& component : covariance.errors.components) {
      const double sd = std::sqrt(redrawn(component, rng));
      std::vector<double> shared(component.groups.count);
      for (double& value : shared) value = sd * rng.normal();
      for (Eigen::Index i = 0; i < n; ++i)
        if (const int group = component.groups.of[i]; group >= 0) residuals(i, draw) += shared[group];
    }
  }
  residuals += covariance.nuisance * nuisances;
  return covariance.whiten(residuals);
}

}  // namespace fathom
