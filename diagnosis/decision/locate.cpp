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
  double p = 1.0;  ///< that errors alone make any stratum depart as one does
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
    const Eigen::ArrayXd p_alone = 2.0 * scores.unaryExpr(&normal_tail);
    const double p = static_cast<double>(columns.cols()) * p_alone.minCoeff();
    if (!(p < level)) break;
    // Something departs. It is described by what is largest, though that may be known by fewer degrees of freedom.
    Eigen::Index best = 0;
    (p_alone < level).select(z.array().abs(), 0.0).maxCoeff(&best);
    result.push_back({best, z[best], p});
    const Eigen::VectorXd direction = left.col(best).normalized();
    residual -= direction * direction.dot(residual);
    left -= direction * (direction.transpose() * left);
  }
  return result;
}

}  // namespace

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
