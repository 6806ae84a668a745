#include "diagnosis/statistics/budget.h"

#include <cmath>

#include "diagnosis/statistics/groups.h"

namespace fathom {

std::vector<ConditionBudget> uncertainty_budget(const Evidence& evidence, const Covariance& covariance) {
  std::vector<ConditionBudget> result;
  const auto& observations = evidence.observations;
  const Groups groups =
      group_by(observations, [](const Observation& o) { return condition_key(o) + "/" + o.observable; });
  for (const auto& rows : groups.members()) {
    const double n = static_cast<double>(rows.size());
    const Observation& first = observations[rows[0]];
    ConditionBudget line{condition_key(first), first.observable};
    for (const auto row : rows) line.comparison_error += (observations[row].value - evidence.predicted[row]) / n;
    const double total = part(covariance, rows).sum() / (n * n);
    const double input = covariance.nuisance(rows, Eigen::all).colwise().sum().squaredNorm() / (n * n);
    const double numerical = covariance.numerical_variance(rows).sum() / (n * n);
    line.u_validation = std::sqrt(total);
    line.u_input = std::sqrt(input);
    line.u_numerical = std::sqrt(numerical);
    line.u_data = std::sqrt(std::max(0.0, total - input - numerical));
    result.push_back(line);
  }
  return result;
}

}  // namespace fathom
