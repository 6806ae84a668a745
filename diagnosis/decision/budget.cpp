#include "diagnosis/decision/budget.h"

#include <cmath>
#include <map>

#include "diagnosis/statistics/groups.h"

namespace fathom {

namespace {

/// Variance that errors of the model which observations share leave in the mean of some of them.
double of_model(const Covariance& covariance, const std::vector<Eigen::Index>& rows) {
  double variance = 0.0;
  for (const ObservableErrors& errors : covariance.errors.observables)
    for (const VarianceComponent& component : errors.components) {
      if (component.level != ErrorLevel::model) continue;
      std::map<int, double> counts;
      for (const auto row : rows)
        if (component.groups.of[row] >= 0) counts[component.groups.of[row]] += component.scale[row];
      for (const auto& [group, count] : counts) variance += component.variance * count * count;
    }
  return variance / std::pow(static_cast<double>(rows.size()), 2.0);
}

std::vector<std::vector<Eigen::Index>> budget_lines(const std::vector<Observation>& observations) {
  return group_by(observations, [](const Observation& o) { return condition_key(o) + "/" + o.observable; }).members();
}

}  // namespace

std::vector<ConditionBudget> uncertainty_budget(const Evidence& evidence, const Covariance& covariance) {
  std::vector<ConditionBudget> result;
  const auto& observations = evidence.observations;
  for (const auto& rows : budget_lines(observations)) {
    const double n = static_cast<double>(rows.size());
    const Observation& first = observations[rows[0]];
    ConditionBudget line{condition_key(first), first.observable};
    for (const auto row : rows) line.comparison_error += (observations[row].value - evidence.predicted[row]) / n;
    const double total = part(covariance, rows).sum() / (n * n);
    const double input = covariance.nuisance(rows, Eigen::all).colwise().sum().squaredNorm() / (n * n);
    const double numerical = covariance.numerical_variance(rows).sum() / (n * n) + of_model(covariance, rows);
    line.u_validation = std::sqrt(total);
    line.u_input = std::sqrt(input);
    line.u_numerical = std::sqrt(numerical);
    line.u_data = std::sqrt(std::max(0.0, total - input - numerical));
    result.push_back(line);
  }
  return result;
}

void set_surrogate_differences(const Evidence& evidence, const Eigen::VectorXd& by_surrogate,
                               std::vector<ConditionBudget>& budget) {
  const std::vector<std::vector<Eigen::Index>> lines = budget_lines(evidence.observations);
  for (std::size_t i = 0; i < budget.size(); ++i) {
    const double difference = (by_surrogate - evidence.predicted)(lines[i]).mean();
    budget[i].surrogate_difference = difference;
    budget[i].u_numerical = std::abs(difference);
    budget[i].u_validation = std::hypot(budget[i].u_data, budget[i].u_input, difference);
  }
}

}  // namespace fathom
