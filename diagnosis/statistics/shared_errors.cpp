#include "diagnosis/statistics/shared_errors.h"

#include <algorithm>

#include "diagnosis/statistics/mean_space.h"
#include "diagnosis/statistics/reml.h"

namespace fathom {

namespace {

/// Means of one observable's cells (equal conditions and region), cells × observations.
Eigen::MatrixXd means_of_cells(const std::vector<Observation>& observations, const std::string& observable) {
  const std::vector<std::vector<Eigen::Index>> cells =
      group_by(observations, [&](const Observation& o) {
        return o.observable == observable ? cell_key(o) : std::string();
      }).members();
  Eigen::MatrixXd means =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(cells.size()), static_cast<Eigen::Index>(observations.size()));
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
    for (const auto row : cells[cell])
      means(static_cast<Eigen::Index>(cell), row) = 1.0 / static_cast<double>(cells[cell].size());
  return means;
}

VarianceComponent component_of(const SharedError& shared, const std::vector<Observation>& observations) {
  VarianceComponent component;
  component.observable = shared.observable;
  component.level = ErrorLevel::model;
  component.variance = shared.sigma * shared.sigma;
  component.groups = {shared.group_of, *std::max_element(shared.group_of.begin(), shared.group_of.end()) + 1};
  component.scale = shared.of_pixels > 0.0 ? errors_of_means(observations, shared.of_pixels)
                                           : Eigen::VectorXd::Ones(static_cast<Eigen::Index>(observations.size()));
  return component;
}

}  // namespace

std::vector<VarianceComponent> expected_shared_errors(const Evidence& evidence) {
  std::vector<VarianceComponent> components;
  for (const SharedError& shared : evidence.shared_errors)
    components.push_back(component_of(shared, evidence.observations));
  return components;
}

std::vector<ObservableErrors> estimate_shared_errors(const Evidence& evidence, const Eigen::VectorXd& residual,
                                                     const Eigen::MatrixXd& known) {
  const std::vector<VarianceComponent> expected = expected_shared_errors(evidence);
  std::vector<ObservableErrors> result;
  const Groups observables = group_by(evidence.observations, [](const Observation& o) { return o.observable; });
  for (const auto& rows : observables.members()) {
    const std::string& observable = evidence.observations[rows[0]].observable;
    ObservableErrors errors;
    std::vector<VariancePrior> priors;
    for (const VarianceComponent& component : expected) {
      if (component.observable != observable) continue;
      errors.components.push_back(component);
      priors.push_back({component.variance, kModelDof});
    }
    if (errors.components.empty()) continue;
    const Eigen::MatrixXd means = means_of_cells(evidence.observations, observable);
    const Eigen::MatrixXd weights = free_of_candidates(evidence, means).transpose() * means;
    std::vector<Eigen::MatrixXd> shapes;
    for (const VarianceComponent& component : errors.components) {
      const Eigen::MatrixXd half = weights * columns_of(component);
      shapes.push_back(half * half.transpose());
    }
    const VarianceFit fit = fit_variances(weights * residual, weights * known * weights.transpose(), shapes, priors);
    Eigen::VectorXd shares(fit.variances.size());
    for (std::size_t k = 0; k < errors.components.size(); ++k) {
      const double found = fit.variances[static_cast<Eigen::Index>(k)];
      errors.components[k].most = kMostOfKnown * priors[k].variance;
      errors.components[k].variance = std::min(found, errors.components[k].most);
      shares[static_cast<Eigen::Index>(k)] = found > 0.0 ? errors.components[k].variance / found : 1.0;
    }
    errors.covariance = shares.asDiagonal() * fit.covariance * shares.asDiagonal();
    result.push_back(std::move(errors));
  }
  return result;
}

}  // namespace fathom
