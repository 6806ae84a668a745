#include "diagnosis/predict/liquid_motion.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "core/dense.h"
#include "core/median.h"
#include "diagnosis/measurement/cup_regions.h"
#include "diagnosis/measurement/desk_motion.h"
#include "diagnosis/statistics/groups.h"

namespace fathom {
namespace {

constexpr double kFewestDof = 8.0;
constexpr double kUnlike = 0.75;  // of the variance elsewhere: noise goes by what is seen, 1 σ
constexpr double kOutlier = 4.5;  // times the median of absolute deviations: 3 σ of normal ones

/// Squares about the means of groups, of which outliers count as far as such go.
struct Squares {
  double sum = 0.0, dof = 0.0;
  double rounding = 0.0;  ///< 1 σ: what scatters by less than this is seen to scatter more, or not at all
  double variance() const { return sum / dof; }
  /// If the true variance is that.
  double error_of(double variance) const { return std::hypot(variance * std::sqrt(2.0 / dof), rounding * rounding); }
};

using Observations = std::vector<Observation>;

double cut_to(double most, double value) { return std::clamp(value, -most, most); }

double rounding_of(const Observations& heights) {
  double rounding = 0.0;
  for (const Observation& o : heights) rounding = std::max(rounding, o.rounding);
  return rounding;
}

double most_of(const std::vector<double>& deviations, double rounding) {
  return kOutlier * std::max(median(deviations), rounding);
}

/// Between trials of a placement.
Squares between_trials(const Observations& heights) {
  std::vector<double> deviations;
  for (const Observation& o : heights)
    if (o.repeats > 1) deviations.push_back(o.repeat_sd);
  Squares squares{.rounding = rounding_of(heights)};
  if (deviations.empty()) return squares;
  const double most = most_of(deviations, squares.rounding);
  for (const Observation& o : heights) {
    squares.dof += o.repeats - 1;
    squares.sum += (o.repeats - 1) * std::pow(cut_to(most, o.repeat_sd), 2);
  }
  return squares;
}

/// Between placements of the same condition, each pour with a mean of its own.
Squares between_placements(const Observations& heights) {
  const Groups cells = group_by(heights, cell_key), pours = group_by(heights, pour_key);
  const auto n = static_cast<Eigen::Index>(heights.size());
  Eigen::MatrixXd means = Eigen::MatrixXd::Zero(n, cells.count + pours.count);
  Eigen::VectorXd values(n);
  for (Eigen::Index row = 0; row < n; ++row) {
    means(row, cells.of[row]) = 1.0;
    if (pours.of[row] >= 0) means(row, cells.count + pours.of[row]) = 1.0;
    values[row] = heights[row].value;
  }
  const Eigen::MatrixXd known = orthonormal(means);
  const Eigen::VectorXd left = values - known * (known.transpose() * values);
  Squares squares{.dof = static_cast<double>(n - known.cols()), .rounding = rounding_of(heights)};
  std::vector<double> deviations;
  for (const double value : left)
    if (std::abs(value) > 1e-9) deviations.push_back(std::abs(value));
  if (deviations.empty()) return squares;
  const double most = most_of(deviations, squares.rounding);
  for (const double value : left) squares.sum += std::pow(cut_to(most, value), 2);
  return squares;
}

/// Whether they have enough degrees of freedom.
bool add(const Squares& clear, const Squares& other, double share, VarianceExcess& excess) {
  if (std::min(clear.dof, other.dof) < kFewestDof) return false;
  const double by_chance = clear.error_of(other.variance()), error = clear.error_of(clear.variance());
  excess.value += share * (clear.variance() - other.variance());
  excess.error = std::hypot(excess.error, share * by_chance,
                            share * std::hypot(other.error_of(other.variance()), kUnlike * other.variance()));
  excess.sampling =
      std::hypot(excess.sampling, share * std::sqrt(std::max(error * error - by_chance * by_chance, 0.0)));
  return true;
}

/// Of one shot: what placements differ by holds a part of what trials do.
std::optional<VarianceExcess> excess_of(const Observations& clear, const Observations& others) {
  if (clear.empty() || others.empty()) return std::nullopt;
  double mean_of_trials = 0.0;
  for (const Observation& o : clear) mean_of_trials += 1.0 / o.repeats / static_cast<double>(clear.size());
  VarianceExcess excess;
  const bool has_placements = add(between_placements(clear), between_placements(others), 1.0, excess);
  const bool has_trials =
      add(between_trials(clear), between_trials(others), has_placements ? 1.0 - mean_of_trials : 1.0, excess);
  const bool is_certain = excess.error == 0.0 && excess.sampling == 0.0;  // heights that are all alike
  if ((!has_placements && !has_trials) || is_certain) return std::nullopt;
  return excess;
}

/// Of the condition in the middle.
Factors middle_of(const Observations& heights) {
  const auto n = static_cast<double>(heights.size());
  double fill = 0.0, distance = 0.0, lateral = 0.0;
  for (const Observation& o : heights) {
    fill += o.factors.fill_mm / n;
    distance += o.factors.distance_mm / n;
    lateral += o.factors.lateral_mm / n;
  }
  const auto off = [&](const Observation& o) {
    const Factors& f = o.factors;
    return std::tuple(std::abs(f.fill_mm - fill), std::abs(f.distance_mm - distance), std::abs(f.lateral_mm - lateral));
  };
  Factors factors = std::min_element(heights.begin(), heights.end(), [&](const Observation& a, const Observation& b) {
                      return off(a) < off(b);
                    })->factors;
  factors.region = kWholeInterior;
  return factors;
}

}  // namespace

std::vector<Observation> liquid_motion(const std::vector<Observation>& observations,
                                       const std::vector<bool>& sees_through) {
  std::map<std::pair<std::string, double>, Observations> clear;  // by liquid and fill
  Observations others;
  for (std::size_t row = 0; row < observations.size(); ++row)
    if (const Observation& o = observations[row]; o.observable == "height_mm")
      (sees_through[row] ? clear[{o.factors.liquid, o.factors.fill_mm}] : others).push_back(o);
  std::vector<Observation> result;
  for (const auto& [filling, heights] : clear)
    if (const auto excess = excess_of(heights, others))
      result.push_back(root_of(*excess, "liquid_motion_mm", middle_of(heights), static_cast<int>(heights.size())));
  return result;
}

}  // namespace fathom
