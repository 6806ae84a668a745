#include "diagnosis/decision/gap_size.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "diagnosis/decision/held_out.h"
#include "diagnosis/statistics/groups.h"

namespace fathom {

namespace {

double rms(const Eigen::VectorXd& values) {
  return values.size() == 0 ? 0.0 : std::sqrt(values.squaredNorm() / static_cast<double>(values.size()));
}

}  // namespace

std::string compared_height(const std::vector<Observation>& observations) {
  const bool in_cups = std::any_of(observations.begin(), observations.end(),
                                   [](const Observation& o) { return o.observable == "height_mm"; });
  return in_cups ? "height_mm" : "desk_height_mm";
}

GapSize gap_size(const Eigen::VectorXd& before, const Eigen::VectorXd& after, const Eigen::VectorXd& variance,
                 const std::vector<Eigen::Index>& rows) {
  return {rms(before(rows)), rms(after(rows)), std::sqrt(variance(rows).mean())};
}

void measure_gaps(const Case& c, const Refit& fit, Diagnosis& diagnosis) {
  const Eigen::VectorXd before = c.covariance.factor.matrixL() * c.problem.residual;
  const Eigen::VectorXd left_w = c.problem.residual - fit.prediction;
  const Eigen::VectorXd left = c.covariance.factor.matrixL() * left_w;
  const Eigen::VectorXd solved = c.covariance.factor.matrixU().solve(left_w);
  const Eigen::VectorXd after = left - c.covariance.nuisance * (c.covariance.nuisance.transpose() * solved);
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

}  // namespace fathom
