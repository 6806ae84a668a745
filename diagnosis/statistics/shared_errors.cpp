#include "diagnosis/statistics/shared_errors.h"

#include <algorithm>

#include "diagnosis/statistics/mean_space.h"
#include "diagnosis/statistics/reml.h"

namespace fathom {

namespace {

/// Means of the cells (equal conditions, observable and region): nothing that follows tells a cell's members apart.
struct Cells {
  Eigen::MatrixXd means;  ///< cells × observations
  std::vector<Eigen::Index> first;

  explicit Cells(const Evidence& evidence, const std::vector<Eigen::Index>& rows) {
    const Groups groups = group_by(evidence.observations, cell_key);
    std::vector<std::vector<Eigen::Index>> members;
    std::vector<int> number(groups.count, -1);
    for (const auto row : rows) {
      int& cell = number[groups.of[row]];
      if (cell < 0) {
        cell = static_cast<int>(members.size());
        members.emplace_back();
        first.push_back(row);
      }
      members[cell].push_back(row);
    }
    means = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(first.size()),
                                  static_cast<Eigen::Index>(evidence.observations.size()));
    for (std::size_t cell = 0; cell < members.size(); ++cell)
      for (const auto row : members[cell])
        means(static_cast<Eigen::Index>(cell), row) = 1.0 / static_cast<double>(members[cell].size());
  }
};

/// How much of each group's error the rows have.
Eigen::MatrixXd membership(const VarianceComponent& component, const std::vector<Eigen::Index>& rows) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows.size()), component.groups.count);
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (const int group = component.groups.of[rows[i]]; group >= 0)
      result(static_cast<Eigen::Index>(i), group) = component.scale[rows[i]];
  return result;
}

}  // namespace

std::vector<ObservableErrors> estimate_shared_errors(const Evidence& evidence, const Eigen::VectorXd& residual,
                                                     const Eigen::MatrixXd& known) {
  std::vector<ObservableErrors> result;
  const Eigen::VectorXd alike = Eigen::VectorXd::Ones(residual.size());
  const Groups observables = group_by(evidence.observations, [](const Observation& o) { return o.observable; });
  for (const auto& rows : observables.members()) {
    const std::string& observable = evidence.observations[rows[0]].observable;
    ObservableErrors errors;
    std::vector<VariancePrior> priors;
    for (const SharedError& shared : evidence.shared_errors) {
      if (shared.observable != observable) continue;
      const int count = *std::max_element(shared.group_of.begin(), shared.group_of.end()) + 1;
      errors.components.push_back(
          {observable,
           ErrorLevel::model,
           0.0,
           {shared.group_of, count},
           shared.of_pixels > 0.0 ? errors_of_means(evidence.observations, shared.of_pixels) : alike});
      priors.push_back({shared.sigma * shared.sigma, kModelDof});
    }
    if (errors.components.empty()) continue;
    const Cells cells(evidence, rows);
    const Eigen::MatrixXd contrasts = free_of_candidates(evidence, cells.means);
    std::vector<Eigen::MatrixXd> shapes;
    for (const VarianceComponent& component : errors.components) {
      const Eigen::MatrixXd half = contrasts.transpose() * membership(component, cells.first);
      shapes.push_back(half * half.transpose());
    }
    const Eigen::MatrixXd weights = contrasts.transpose() * cells.means;
    const VarianceFit fit = fit_variances(weights * residual, weights * known * weights.transpose(), shapes, priors);
    Eigen::VectorXd shares(fit.variances.size());
    for (std::size_t k = 0; k < errors.components.size(); ++k) {
      const double found = fit.variances[static_cast<Eigen::Index>(k)];
      errors.components[k].variance = std::min(found, kMostOfModel * priors[k].variance);
      shares[static_cast<Eigen::Index>(k)] = found > 0.0 ? errors.components[k].variance / found : 1.0;
    }
    errors.covariance = shares.asDiagonal() * fit.covariance * shares.asDiagonal();
    result.push_back(std::move(errors));
  }
  return result;
}

}  // namespace fathom
