#include "diagnosis/decision/limits.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/dense.h"
#include "diagnosis/statistics/decision_settings.h"

namespace fathom {

namespace {

constexpr double kConfusable_deg = 15.0;
constexpr double kNearNull = 0.1;
constexpr double kPartOf = 0.2;              // weight from which on an effect is part of a direction
constexpr double kLeastInformation = 1e-12;  // of a typical departure: less is rounding
constexpr double kLeastStrength = 0.5;       // a typical departure below this is not seen anyway

}  // namespace

std::vector<UpperLimit> upper_limits(const Evidence& evidence, const Problem& problem, const std::vector<int>& named,
                                     const Eigen::VectorXd& residual, const Eigen::MatrixXd& explained) {
  std::vector<UpperLimit> result;
  for (std::size_t effect = 0; effect < problem.columns.size(); ++effect) {
    if (std::find(named.begin(), named.end(), static_cast<int>(effect)) != named.end()) continue;
    const Candidate& candidate = evidence.candidates[effect];
    for (std::size_t k = 0; k < candidate.parameters.size(); ++k) {
      const Eigen::VectorXd sensitivity = without(problem.sensitivities.col(problem.columns[effect][k]), explained);
      const double information = sensitivity.squaredNorm();
      const Parameter& parameter = candidate.parameters[k];
      const double widest =
          std::max(std::abs(parameter.upper - parameter.nominal), std::abs(parameter.lower - parameter.nominal));
      const double sigma = information > kLeastInformation ? parameter.prior_scale / std::sqrt(information) : HUGE_VAL;
      const double estimate =
          information > kLeastInformation ? parameter.prior_scale * sensitivity.dot(residual) / information : 0.0;
      const double limit = std::abs(estimate) + 1.96 * sigma;
      const double threshold = std::sqrt(
          std::max(0.0, 2.0 * (std::log(kAlarmOdds) - problem.log_odds[effect]) + parameter_cost(information)));
      if (!std::isfinite(limit)) continue;  // the observations do not see it at all
      result.push_back(
          {candidate.effect, parameter.name, widest > 0.0 ? std::min(limit, widest) : limit, threshold * sigma});
    }
  }
  return result;
}

std::vector<SizeError> size_errors(const Evidence& evidence, const Problem& problem) {
  std::vector<SizeError> result;
  for (std::size_t effect = 0; effect < problem.columns.size(); ++effect)
    for (std::size_t k = 0; k < problem.columns[effect].size(); ++k) {
      const Candidate& candidate = evidence.candidates[effect];
      const double information = problem.sensitivities.col(problem.columns[effect][k]).squaredNorm();
      if (information > kLeastInformation)
        result.push_back({candidate.effect, candidate.parameters[k].name,
                          candidate.parameters[k].prior_scale / std::sqrt(information)});
    }
  return result;
}

std::vector<ConfusablePair> confusable_pairs(const Evidence& evidence, const Problem& problem) {
  std::vector<Eigen::MatrixXd> bases;
  std::vector<bool> is_seen;
  for (const auto& columns : problem.columns) {
    const Eigen::MatrixXd sensitivities = problem.sensitivities(Eigen::all, columns);
    bases.push_back(orthonormal(sensitivities));
    is_seen.push_back(sensitivities.norm() > kLeastStrength);
  }
  std::vector<ConfusablePair> result;
  for (std::size_t i = 0; i < bases.size(); ++i)
    for (std::size_t j = i + 1; j < bases.size(); ++j) {
      if (!is_seen[i] || !is_seen[j]) continue;
      // Sine from what is left of one in the other's complement: accurate for small angles.
      const Eigen::MatrixXd& larger = bases[i].cols() >= bases[j].cols() ? bases[i] : bases[j];
      const Eigen::MatrixXd& smaller = bases[i].cols() >= bases[j].cols() ? bases[j] : bases[i];
      const Eigen::MatrixXd left = smaller - larger * (larger.transpose() * smaller);
      const double sine = std::sqrt(symmetric_eigen(left.transpose() * left).values.maxCoeff());
      const double angle_deg = std::asin(std::min(1.0, sine)) * 180.0 / std::numbers::pi;
      if (angle_deg < kConfusable_deg)
        result.push_back({evidence.candidates[i].effect, evidence.candidates[j].effect, angle_deg});
    }
  std::stable_sort(result.begin(), result.end(),
                   [](const ConfusablePair& a, const ConfusablePair& b) { return a.angle_deg < b.angle_deg; });
  return result;
}

std::vector<NearNullDirection> near_null_directions(const Evidence& evidence, const Problem& problem) {
  std::vector<Eigen::Index> columns;
  std::vector<std::string> names;
  for (std::size_t effect = 0; effect < problem.columns.size(); ++effect)
    for (const auto column : problem.columns[effect])
      if (problem.sensitivities.col(column).norm() > kLeastStrength) {
        columns.push_back(column);
        names.push_back(evidence.candidates[effect].effect);
      }
  std::vector<NearNullDirection> result;
  if (columns.empty()) return result;
  const Eigen::MatrixXd unit = problem.sensitivities(Eigen::all, columns).colwise().normalized();
  const SymmetricEigen eigen = symmetric_eigen(unit.transpose() * unit);
  for (Eigen::Index k = 0; k < eigen.values.size(); ++k) {
    const double strength = std::sqrt(std::max(0.0, eigen.values[k]));
    if (strength > kNearNull) break;
    NearNullDirection direction{{}, {}, strength};
    for (Eigen::Index i = 0; i < unit.cols(); ++i)
      if (const double weight = eigen.vectors(i, k); std::abs(weight) > kPartOf) {
        direction.effects.push_back(names[i]);
        direction.weights.push_back(weight);
      }
    if (direction.effects.size() >= 3) result.push_back(std::move(direction));
  }
  return result;
}

}  // namespace fathom
