#include "diagnosis/decision/locate.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "diagnosis/statistics/distributions.h"

namespace fathom {

namespace {

constexpr int kMostLocations = 12;
constexpr double kAbsorbed = 0.05;  // share of a column's squared norm below which nothing new is in it

struct SignificantStratum {
  Eigen::Index number = 0;
  double z = 0.0;  ///< of what those before it leave
  double p = 1.0;  ///< as in GapLocation
};

/// Whether one holds all observations of the other.
bool is_part(const Stratum& of, const Stratum& part) { return std::ranges::includes(of.rows, part.rows); }

std::vector<SignificantStratum> significant_strata(const std::vector<Stratum>& strata, const Eigen::MatrixXd& columns,
                                                   const Eigen::VectorXd& dof, Eigen::VectorXd residual, double level,
                                                   const std::vector<ExplainedStratum>& explained) {
  std::vector<SignificantStratum> result;
  Eigen::MatrixXd left = columns;
  const Eigen::VectorXd full = columns.colwise().squaredNorm();
  const auto take = [&](Eigen::Index number, double z, double p) {
    result.push_back({number, z, p});
    const Eigen::VectorXd direction = left.col(number).normalized();
    residual -= direction * direction.dot(residual);
    left -= direction * (direction.transpose() * left);
  };
  while (static_cast<int>(result.size()) < kMostLocations) {
    const Eigen::VectorXd squares = left.colwise().squaredNorm();
    Eigen::VectorXd z = (left.transpose() * residual).array() / squares.array().max(1e-300).sqrt();
    z = (squares.array() > kAbsorbed * full.array()).select(z, 0.0);
    const Eigen::ArrayXd scores = z.cwiseAbs().binaryExpr(dof, &normal_score).array();
    const Eigen::ArrayXd p_alone = 2.0 * scores.unaryExpr(&normal_tail);
    const double p = static_cast<double>(columns.cols()) * p_alone.minCoeff();
    if (!(p < level)) break;
    // Something departs. It is described by what is largest, though that may be known by fewer degrees of freedom.
    Eigen::Index best = 0;
    (p_alone < level).select(z.array().abs(), 0.0).maxCoeff(&best);
    take(best, z[best], p);
  }
  for (const ExplainedStratum& one : explained) {
    const bool is_listed = std::ranges::any_of(result, [&](const SignificantStratum& listed) {
      const Stratum &a = strata[listed.number], &b = strata[one.number];
      return is_part(a, b) || is_part(b, a);
    });
    const double squares = left.col(one.number).squaredNorm();
    if (is_listed || squares <= kAbsorbed * full[one.number]) continue;
    take(one.number, left.col(one.number).dot(residual) / std::sqrt(squares), one.p);
  }
  return result;
}

}  // namespace

std::vector<ExplainedStratum> liquids_with(const Case& c, const Eigen::VectorXd& explained, double level) {
  const Eigen::VectorXd predicted = c.covariance.factor.matrixL() * explained,
                        measured = c.covariance.factor.matrixL() * c.problem.residual;
  const auto is_of_liquid = [&](const Stratum& stratum) {
    return stratum.is_main && stratum.observable == "height_mm" && stratum.name.starts_with("liquid=");
  };
  const auto liquids = std::ranges::count_if(c.strata, is_of_liquid);
  std::vector<ExplainedStratum> result;
  for (std::size_t k = 0; k < c.strata.size(); ++k) {
    if (!is_of_liquid(c.strata[k])) continue;
    const std::vector<Eigen::Index>& rows = c.strata[k].rows;
    const Eigen::LLT<Eigen::MatrixXd> errors(part(c.covariance, rows));
    const Eigen::VectorXd direction = errors.matrixL().solve(Eigen::VectorXd(predicted(rows))).normalized();
    Eigen::VectorXd column = Eigen::VectorXd::Zero(predicted.size());
    column(rows) = predicted(rows);
    if (column.isZero()) continue;
    const double z = direction.dot(errors.matrixL().solve(Eigen::VectorXd(measured(rows)))),
                 dof = degrees_of_freedom(c.covariance, c.covariance.whiten(column))[0],
                 p = static_cast<double>(liquids) * normal_tail(normal_score(z, dof));
    if (z > 0.0 && p < level) result.push_back({static_cast<Eigen::Index>(k), p});
  }
  return result;
}

std::vector<GapLocation> locate(const std::vector<Stratum>& strata, const Eigen::MatrixXd& columns,
                                const Eigen::VectorXd& dof, const Eigen::VectorXd& residual, double level,
                                const std::vector<ExplainedStratum>& explained) {
  const std::vector<SignificantStratum> found = significant_strata(strata, columns, dof, residual, level, explained);
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
