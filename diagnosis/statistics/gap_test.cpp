#include "diagnosis/statistics/gap_test.h"

#include <cmath>

#include "diagnosis/statistics/distributions.h"
#include "diagnosis/statistics/groups.h"
#include "diagnosis/statistics/problem.h"
#include "diagnosis/statistics/smooth_score.h"

namespace fathom {

namespace {

constexpr Eigen::Index kFewestWithinCells = 8;
constexpr double kLeastWithin =
    0.1;  // mean square of scatter within cells, of what the covariance expects: noiseless data
constexpr double kLeastLeft = 0.05;  // of a column's norm, for it to be looked at still

/// Orthonormal basis of the whitened means of all cells.
Eigen::MatrixXd cell_space(const Evidence& evidence, const Covariance& covariance) {
  const Groups cells = group_by(evidence.observations, cell_key);
  const Eigen::Index n = covariance.total.rows();
  if (n - cells.count < kFewestWithinCells) return Eigen::MatrixXd(n, 0);
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(n, cells.count);
  for (Eigen::Index i = 0; i < n; ++i) columns(i, cells.of[i]) = 1.0;
  return orthonormal(covariance.whiten(columns));
}

Eigen::MatrixXd without(const Eigen::MatrixXd& x, const Eigen::MatrixXd& explained) {
  if (explained.cols() == 0) return x;
  return x - explained * (explained.transpose() * x);
}

/// Unit columns; those with hardly anything left become 0.
Eigen::MatrixXd unit_columns(const Eigen::MatrixXd& x, const Eigen::VectorXd& norms_before) {
  Eigen::MatrixXd result = x;
  for (Eigen::Index k = 0; k < x.cols(); ++k) {
    const double norm = x.col(k).norm();
    result.col(k) *= norm > kLeastLeft * norms_before[k] ? 1.0 / norm : 0.0;
  }
  return result;
}

/// One statistic of the data and of each draw.
struct Statistic {
  double data;
  Eigen::VectorXd draws;
};

/// f of the columns' projections: of the residual (one column) and of the draws.
template <class F>
Statistic statistic(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& residual, const Eigen::MatrixXd& draws,
                    F f) {
  return {f(Eigen::MatrixXd(columns.transpose() * residual), residual)[0],
          f(Eigen::MatrixXd(columns.transpose() * draws), draws)};
}

Eigen::VectorXd sum_of_squares(const Eigen::MatrixXd& projected, const Eigen::MatrixXd&) {
  return projected.colwise().squaredNorm();
}

/// Largest |z| in each column, each row with its own degrees of freedom.
Eigen::VectorXd largest(const Eigen::MatrixXd& projected, const Eigen::VectorXd& dof) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(projected.cols());
  for (Eigen::Index draw = 0; draw < projected.cols(); ++draw)
    for (Eigen::Index k = 0; k < projected.rows(); ++k)
      result[draw] = std::max(result[draw], normal_score(projected(k, draw), dof[k]));
  return result;
}

/// p of the data, and z for every draw as if it were the data: what joins tests of different kinds.
template <class Tail>
double calibrate(const Statistic& s, const Tail& tail, Eigen::VectorXd& largest_z, double& data_z) {
  const auto z = [&](double value) { return normal_quantile(tail.p(value)); };
  for (Eigen::Index k = 0; k < s.draws.size(); ++k) largest_z[k] = std::max(largest_z[k], z(s.draws[k]));
  data_z = std::max(data_z, z(s.data));
  return tail.p(s.data);
}

}  // namespace

GapShapes gap_shapes(const Evidence& evidence, const Covariance& covariance) {
  GapShapes shapes;
  shapes.strata = list_strata(evidence.observations);
  shapes.stratum_columns = stratum_columns(shapes.strata, covariance);
  shapes.stratum_dof = degrees_of_freedom(covariance, shapes.stratum_columns);
  shapes.smooth_factor = smooth_factor(evidence, covariance);
  shapes.smooth = covariance.whiten(shapes.smooth_factor);
  shapes.cells = cell_space(evidence, covariance);
  return shapes;
}

GapTest gap_test(const GapShapes& shapes, const Eigen::VectorXd& residual, const Eigen::MatrixXd& draws,
                 const Eigen::MatrixXd& explained) {
  const Eigen::MatrixXd left = without(residual, explained), draws_left = without(draws, explained);
  const Eigen::MatrixXd strata =
      unit_columns(without(shapes.stratum_columns, explained), shapes.stratum_columns.colwise().norm().transpose());
  std::vector<Eigen::Index> main_effects;
  for (std::size_t k = 0; k < shapes.strata.size(); ++k)
    if (shapes.strata[k].is_main) main_effects.push_back(static_cast<Eigen::Index>(k));

  GapTest test;
  Eigen::VectorXd largest_z = Eigen::VectorXd::Constant(draws.cols(), -INFINITY);
  double data_z = -INFINITY;
  const auto quadratic = [&](const Statistic& s) { return calibrate(s, fit_quadratic(s.draws), largest_z, data_z); };
  test.p_strata = quadratic(statistic(orthonormal(strata(Eigen::all, main_effects)), left, draws_left, sum_of_squares));
  test.p_smooth = quadratic(statistic(without(shapes.smooth, explained), left, draws_left, sum_of_squares));
  const Statistic scan = statistic(
      strata, left, draws_left,
      [&](const Eigen::MatrixXd& projected, const Eigen::MatrixXd&) { return largest(projected, shapes.stratum_dof); });
  test.scan_tail = fit_maximum(scan.draws);
  test.p_scan = calibrate(scan, test.scan_tail, largest_z, data_z);
  if (shapes.cells.cols() > 0) {
    const double between = static_cast<double>(shapes.cells.cols() - explained.cols());
    const double within = static_cast<double>(residual.size() - shapes.cells.cols());
    test.p_lack_of_fit = quadratic(
        statistic(shapes.cells, left, draws_left, [&](const Eigen::MatrixXd& means, const Eigen::MatrixXd& all) {
          const Eigen::VectorXd explained_squares = means.colwise().squaredNorm();
          const Eigen::VectorXd squares = all.colwise().squaredNorm();
          return Eigen::VectorXd((explained_squares.array() / between) /
                                 ((squares - explained_squares).array() / within).max(kLeastWithin));
        }));
  }
  test.p = fit_maximum(largest_z).p(data_z);
  return test;
}

}  // namespace fathom
