#include "diagnosis/statistics/scan.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "diagnosis/statistics/distributions.h"
#include "diagnosis/statistics/groups.h"

namespace fathom {

namespace {

constexpr std::size_t kFewestInPair = 3;
constexpr int kMostLocations = 12;
constexpr double kAbsorbed = 0.05;  // share of a column's squared norm below which nothing new is in it

std::vector<Stratum> strata_by(const std::vector<Observation>& observations, const std::string& observable,
                               const std::vector<std::string>& factors) {
  std::vector<std::string> names;
  const Groups groups = group_by(observations, [&](const Observation& o) {
    std::string name;
    if (o.observable != observable) return name;
    for (const std::string& factor : factors) {
      const std::string value = level(o, factor);
      if (value.empty()) return std::string();
      name += (name.empty() ? "" : ", ") + factor + "=" + value;
    }
    return name.empty() ? std::string("all") : name;
  });
  std::vector<Stratum> result;
  for (auto& rows : groups.members()) {
    std::string name;
    for (const std::string& factor : factors)
      name += (name.empty() ? "" : ", ") + factor + "=" + level(observations[rows[0]], factor);
    result.push_back({observable, name.empty() ? "all" : name, factors.size() < 2, std::move(rows)});
  }
  return result;
}

/// The rows of one observable that were measured in the first, second and last third of a span of time.
std::vector<Stratum> strata_by_time(const std::vector<Observation>& observations, const std::vector<Eigen::Index>& rows,
                                    const std::string& name, const std::function<std::string(const Observation&)>& span,
                                    double Factors::*time) {
  static constexpr std::array kThirds{"early", "middle", "late"};
  std::map<std::string, std::pair<double, double>> spans;
  for (const auto row : rows) {
    const double t = observations[row].factors.*time;
    auto& [first, last] = spans.try_emplace(span(observations[row]), t, t).first->second;
    first = std::min(first, t);
    last = std::max(last, t);
  }
  std::vector<Stratum> result;
  for (const char* third : kThirds) result.push_back({observations[rows[0]].observable, name + "=" + third, true, {}});
  for (const auto row : rows) {
    const auto [first, last] = spans.at(span(observations[row]));
    if (last <= first) continue;
    const double share = (observations[row].factors.*time - first) / (last - first);
    result[static_cast<std::size_t>(std::clamp(3.0 * share, 0.0, 2.0))].rows.push_back(row);
  }
  return result;
}

struct SignificantStratum {
  Eigen::Index number = 0;
  double z = 0.0, p = 1.0;  ///< of what those before it leave
};

std::vector<SignificantStratum> significant_strata(const Eigen::MatrixXd& columns, const Eigen::VectorXd& dof,
                                                   Eigen::VectorXd residual, double level) {
  std::vector<SignificantStratum> result;
  Eigen::MatrixXd left = columns;
  const Eigen::VectorXd full = columns.colwise().squaredNorm();
  while (static_cast<int>(result.size()) < kMostLocations) {
    const Eigen::VectorXd squares = left.colwise().squaredNorm();
    Eigen::VectorXd z = (left.transpose() * residual).array() / squares.array().max(1e-300).sqrt();
    z = (squares.array() > kAbsorbed * full.array()).select(z, 0.0);
    const Eigen::ArrayXd scores = z.cwiseAbs().binaryExpr(dof, &normal_score).array();
    const Eigen::ArrayXd p = scores.unaryExpr(
        [&](double score) { return std::min(1.0, 2.0 * static_cast<double>(columns.cols()) * normal_tail(score)); });
    // Of what chance does not explain the largest, though it may be known by fewer degrees of freedom.
    Eigen::Index best = 0;
    if ((p < level).select(z.array().abs(), 0.0).maxCoeff(&best) == 0.0) break;
    result.push_back({best, z[best], p[best]});
    const Eigen::VectorXd direction = left.col(best).normalized();
    residual -= direction * direction.dot(residual);
    left -= direction * (direction.transpose() * left);
  }
  return result;
}

}  // namespace

std::vector<Stratum> list_strata(const std::vector<Observation>& observations) {
  std::vector<Stratum> result;
  std::set<std::vector<Eigen::Index>> known;
  const Groups observables = group_by(observations, [](const Observation& o) { return o.observable; });
  const auto add = [&](std::vector<Stratum> strata, std::size_t fewest) {
    for (Stratum& stratum : strata)
      if (stratum.rows.size() >= fewest && known.insert(stratum.rows).second) result.push_back(std::move(stratum));
  };
  for (const auto& rows : observables.members()) {
    const std::string& observable = observations[rows[0]].observable;
    const auto& factors = factor_names();
    add(strata_by(observations, observable, {}), 1);
    for (const std::string& factor : factors) add(strata_by(observations, observable, {factor}), 1);
    for (std::size_t i = 0; i < factors.size(); ++i)
      for (std::size_t j = i + 1; j < factors.size(); ++j)
        add(strata_by(observations, observable, {factors[i], factors[j]}), kFewestInPair);
    // What drifts, and what evaporates.
    add(strata_by_time(observations, rows, "time", session_key, &Factors::time_s), kFewestInPair);
    add(strata_by_time(observations, rows, "time_since_pour", pour_key, &Factors::stood_s), kFewestInPair);
  }
  return result;
}

Eigen::MatrixXd stratum_columns(const std::vector<Stratum>& strata, const Covariance& covariance) {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(covariance.total.rows(), static_cast<Eigen::Index>(strata.size()));
  for (std::size_t k = 0; k < strata.size(); ++k)
    for (const auto row : strata[k].rows) columns(row, static_cast<Eigen::Index>(k)) = 1.0;
  return covariance.whiten(columns);
}

std::vector<GapLocation> locate(const std::vector<Stratum>& strata, const Eigen::MatrixXd& columns,
                                const Eigen::VectorXd& dof, const Eigen::VectorXd& residual, double level) {
  const std::vector<SignificantStratum> found = significant_strata(columns, dof, residual, level);
  if (found.empty()) return {};
  double found_squares = 0.0;
  for (const SignificantStratum& one : found) found_squares += one.z * one.z;
  const double gap = std::max(residual.squaredNorm() - static_cast<double>(residual.size()), found_squares);
  std::vector<Eigen::Index> numbers;
  for (const SignificantStratum& one : found) numbers.push_back(one.number);
  const Eigen::MatrixXd together = columns(Eigen::all, numbers);
  const Eigen::MatrixXd covariance = (together.transpose() * together).inverse();
  const Eigen::VectorXd means = covariance * (together.transpose() * residual);
  std::vector<GapLocation> result;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const Stratum& stratum = strata[found[k].number];
    const auto column = static_cast<Eigen::Index>(k);
    result.push_back({stratum.observable, stratum.name, means[column], std::sqrt(covariance(column, column)),
                      found[k].z * found[k].z / gap, found[k].p});
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const GapLocation& a, const GapLocation& b) { return a.share_of_gap > b.share_of_gap; });
  return result;
}

}  // namespace fathom
