#include "diagnosis/decision/gap_size.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "diagnosis/statistics/groups.h"
#include "diagnosis/statistics/problem.h"

namespace fathom {

namespace {

double rms(const Eigen::VectorXd& values) {
  return values.size() == 0 ? 0.0 : std::sqrt(values.squaredNorm() / static_cast<double>(values.size()));
}

/// The observable whose differences are a gap's size: heights in cups; where there are none, the sensor's above the
/// desk.
std::string compared_height(const std::vector<Observation>& observations) {
  const bool in_cups = std::any_of(observations.begin(), observations.end(),
                                   [](const Observation& o) { return o.observable == "height_mm"; });
  return in_cups ? "height_mm" : "desk_height_mm";
}

/// Of some observations' differences before and after, and of their errors' variance.
GapSize gap_size(const Eigen::VectorXd& before, const Eigen::VectorXd& after, const Eigen::VectorXd& variance,
                 const std::vector<Eigen::Index>& rows) {
  return {rms(before(rows)), rms(after(rows)), std::sqrt(variance(rows).mean())};
}

/// Whether observations of the rows tell every parameter.
bool tell_all(const LinearFit& fit, const std::vector<Eigen::Index>& rows) {
  constexpr double kShare = 1e-3;  // of a sensitivity's squared length
  for (Eigen::Index k = 0; k < fit.jacobian.cols(); ++k)
    if (fit.jacobian.col(k)(rows).squaredNorm() <= kShare * fit.jacobian.col(k).squaredNorm()) return false;
  return true;
}

/// `moved`: of each nuisance, in its σ.
std::vector<TakenUp> taken_up(const Case& c, const Eigen::VectorXd& moved, const std::vector<Eigen::Index>& rows,
                              double residual_rms) {
  constexpr double kWorthARow = 0.1;
  std::map<std::string, Eigen::VectorXd> changes;
  for (std::size_t k = 0; k < c.evidence.nuisances.size(); ++k) {
    const Nuisance& nuisance = c.evidence.nuisances[k];
    const auto column = static_cast<Eigen::Index>(k);
    const auto [change, is_new] = changes.try_emplace(nuisance.kind.empty() ? nuisance.name : nuisance.kind);
    if (is_new) change->second.setZero(static_cast<Eigen::Index>(rows.size()));
    change->second += moved[column] * c.covariance.nuisance.col(column)(rows);
  }
  std::vector<TakenUp> result;
  for (const auto& [input, change] : changes)
    if (const double size = rms(change); size > kWorthARow * residual_rms) result.push_back({input, size});
  std::stable_sort(result.begin(), result.end(),
                   [](const TakenUp& a, const TakenUp& b) { return a.rms_mm > b.rms_mm; });
  return result;
}

}  // namespace

void measure_gaps(const Case& c, const Refit& fit, Diagnosis& diagnosis) {
  const Eigen::VectorXd before = c.covariance.factor.matrixL() * c.problem.residual;
  const Eigen::VectorXd left_w = c.problem.residual - fit.prediction;
  const Eigen::VectorXd left = c.covariance.factor.matrixL() * left_w;
  const Eigen::VectorXd solved = c.covariance.factor.matrixU().solve(left_w);
  const Eigen::VectorXd moved = c.covariance.nuisance.transpose() * solved;
  const Eigen::VectorXd after = left - c.covariance.nuisance * moved;
  const Eigen::VectorXd errors = c.covariance.total.diagonal() - c.covariance.nuisance.rowwise().squaredNorm();
  diagnosis.residuals.before.assign(before.begin(), before.end());
  diagnosis.residuals.after.assign(after.begin(), after.end());
  for (const double variance : errors) diagnosis.residuals.error.push_back(std::sqrt(variance));
  std::vector<Eigen::Index> heights;
  const std::string compared = compared_height(c.evidence.observations);
  for (std::size_t i = 0; i < c.evidence.observations.size(); ++i)
    if (c.evidence.observations[i].observable == compared) heights.push_back(static_cast<Eigen::Index>(i));
  if (heights.empty()) return;
  const HeldOut other =
      held_out(linear_fit(c.covariance, c.problem, fit), deal_folds(c.evidence.observations, c.settings.seed));
  const auto train = [&](const std::vector<Eigen::Index>& rows) { return gap_size(before, after, errors, rows); };
  const auto held = [&](const std::vector<Eigen::Index>& rows) {
    return gap_size(before, other.residual, other.variance, rows);
  };
  diagnosis.gap.train = train(heights);
  diagnosis.gap.taken_up = taken_up(c, moved, heights, diagnosis.gap.train.before_rms_mm);
  diagnosis.gap.held_out = held(heights);
  for (const std::string factor : {"liquid", "fill_mm", "distance_mm", "lateral_mm"}) {
    std::map<std::string, std::vector<Eigen::Index>> levels;
    for (const Eigen::Index row : heights)
      if (const Observation& o = c.evidence.observations[row]; o.factors.liquid != "none")
        levels[level(o, factor)].push_back(row);
    for (const auto& [name, rows] : levels)
      diagnosis.gap.strata.push_back({factor + "=" + name, train(rows), held(rows)});
  }
}

std::vector<LeftOutLevel> left_out_levels(const Evidence& evidence, const LinearFit& fit) {
  std::vector<LeftOutLevel> result;
  const auto count = static_cast<Eigen::Index>(evidence.observations.size());
  const Eigen::VectorXd before = measured_minus_predicted(evidence);
  const std::string compared = compared_height(evidence.observations);
  for (const std::string factor : {"liquid", "distance_mm"}) {
    const Groups levels = group_by(evidence.observations, [&](const Observation& o) {
      return o.observable == compared && o.factors.liquid != "none" ? level(o, factor) : std::string();
    });
    const auto members = levels.members();
    for (const std::vector<Eigen::Index>& rows : members) {
      const std::string name = level(evidence.observations[rows.front()], factor);
      std::vector<int> folds(evidence.observations.size(), 1);
      std::vector<Eigen::Index> others;
      for (Eigen::Index row = 0; row < count; ++row)
        if (level(evidence.observations[row], factor) == name)
          folds[row] = 0;
        else
          others.push_back(row);
      if (members.size() < 2 || !tell_all(fit, others)) continue;
      const HeldOut other = held_out(fit, folds);
      result.push_back({factor + "=" + name, gap_size(before, other.residual, other.variance, rows)});
    }
  }
  return result;
}

}  // namespace fathom
