#include "diagnosis/statistics/gap_test.h"

#include <Eigen/Eigenvalues>
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

/// What makes unit columns of `left`; 0 where hardly anything is left of a column.
Eigen::VectorXd to_unit(const Eigen::MatrixXd& left, const Eigen::VectorXd& norms_before) {
  Eigen::VectorXd factors(left.cols());
  for (Eigen::Index k = 0; k < left.cols(); ++k) {
    const double norm = left.col(k).norm();
    factors[k] = norm > kLeastLeft * norms_before[k] ? 1.0 / norm : 0.0;
  }
  return factors;
}

WeightedDirections main_effects(const GapShapes& shapes, const Covariance& covariance) {
  std::vector<Eigen::Index> main;
  for (std::size_t k = 0; k < shapes.strata.size(); ++k)
    if (shapes.strata[k].is_main) main.push_back(static_cast<Eigen::Index>(k));
  const Eigen::MatrixXd columns = orthonormal(shapes.stratum_columns(Eigen::all, main));
  return {columns, Eigen::VectorXd::Ones(columns.cols()), degrees_of_freedom(covariance, columns)};
}

/// Eigenvectors of the whitened process; λ / (1 + λ) is the share of a direction's variance that would be the
/// process's.
WeightedDirections smooth_departures(const Eigen::MatrixXd& smooth, const Covariance& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(smooth.transpose() * smooth);
  const Eigen::ArrayXd values = eigen.eigenvalues().array().max(1e-12);
  const Eigen::MatrixXd columns = smooth * eigen.eigenvectors() * values.rsqrt().matrix().asDiagonal();
  return {columns, values / (1.0 + values), degrees_of_freedom(covariance, columns)};
}

/// One statistic of the data and of each draw.
struct Statistic {
  double data;
  Eigen::VectorXd draws;
};

/// Projections of data and draws on columns, all of them without what is explained.
struct Projections {
  Eigen::MatrixXd data, draws;  ///< columns × 1 and × draws

  /// f of both.
  template <class F>
  Statistic statistic(F f) const {
    return {f(data)[0], f(draws)};
  }
};

/// What a test starts from: with E what is explained, Cᵀ D − (Eᵀ C)ᵀ Eᵀ D are the projections of what is left.
struct Left {
  const Eigen::MatrixXd& explained;
  Eigen::VectorXd data;             ///< what is left of it
  Eigen::MatrixXd draws_explained;  ///< Eᵀ D

  Projections on(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& projected_draws) const {
    return {columns.transpose() * data,
            projected_draws - (explained.transpose() * columns).transpose() * draws_explained};
  }
  Projections on_unit(const Eigen::MatrixXd& columns, const Eigen::VectorXd& norms,
                      const Eigen::MatrixXd& projected_draws) const {
    const Eigen::VectorXd factors = to_unit(without(columns, explained), norms);
    const Projections all = on(columns, projected_draws);
    return {factors.asDiagonal() * all.data, factors.asDiagonal() * all.draws};
  }
};

/// Σ weight · z² of each column of projections, each z as of a normal.
Eigen::VectorXd weighted_squares(const Eigen::MatrixXd& projected, const WeightedDirections& directions) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(projected.cols());
  for (Eigen::Index draw = 0; draw < projected.cols(); ++draw)
    for (Eigen::Index k = 0; k < projected.rows(); ++k)
      result[draw] += directions.weights[k] * std::pow(normal_score(projected(k, draw), directions.dof[k]), 2.0);
  return result;
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
  shapes.main_effects = main_effects(shapes, covariance);
  shapes.smooth_departures = smooth_departures(shapes.smooth, covariance);
  shapes.cells = cell_space(evidence, covariance);
  return shapes;
}

GapDraws gap_draws(const GapShapes& shapes, Eigen::MatrixXd draws) {
  GapDraws result{.all = std::move(draws), .strata = {}, .main_effects = {}, .smooth_departures = {}, .cells = {}};
  result.strata = shapes.stratum_columns.transpose() * result.all;
  result.main_effects = shapes.main_effects.columns.transpose() * result.all;
  result.smooth_departures = shapes.smooth_departures.columns.transpose() * result.all;
  result.cells = shapes.cells.transpose() * result.all;
  return result;
}

GapTest gap_test(const GapShapes& shapes, const Eigen::VectorXd& residual, const GapDraws& draws,
                 const Eigen::MatrixXd& explained) {
  const Left left{explained, without(residual, explained), explained.transpose() * draws.all};
  GapTest test;
  Eigen::VectorXd largest_z = Eigen::VectorXd::Constant(draws.all.cols(), -INFINITY);
  double data_z = -INFINITY;
  const auto quadratic = [&](const Statistic& s) { return calibrate(s, fit_quadratic(s.draws), largest_z, data_z); };
  const auto sum_over = [&](const WeightedDirections& directions, const Eigen::MatrixXd& projected_draws) {
    const Eigen::VectorXd norms = Eigen::VectorXd::Ones(directions.columns.cols());
    return quadratic(
        left.on_unit(directions.columns, norms, projected_draws).statistic([&](const Eigen::MatrixXd& projected) {
          return weighted_squares(projected, directions);
        }));
  };
  test.p_strata = sum_over(shapes.main_effects, draws.main_effects);
  test.p_smooth = sum_over(shapes.smooth_departures, draws.smooth_departures);
  const Statistic scan =
      left.on_unit(shapes.stratum_columns, shapes.stratum_columns.colwise().norm(), draws.strata)
          .statistic([&](const Eigen::MatrixXd& projected) { return largest(projected, shapes.stratum_dof); });
  test.scan_tail = fit_maximum(scan.draws);
  test.p_scan = calibrate(scan, test.scan_tail, largest_z, data_z);
  if (shapes.cells.cols() > 0) {
    const double between = static_cast<double>(shapes.cells.cols() - explained.cols());
    const double within = static_cast<double>(residual.size() - shapes.cells.cols());
    const auto ratio = [&](const Eigen::MatrixXd& means, const Eigen::ArrayXd& squares) -> Eigen::VectorXd {
      const Eigen::ArrayXd of_means = means.colwise().squaredNorm();
      return (of_means / between) / ((squares - of_means) / within).max(kLeastWithin);
    };
    const Projections means = left.on(shapes.cells, draws.cells);
    const Eigen::ArrayXd squares = draws.all.colwise().squaredNorm() - left.draws_explained.colwise().squaredNorm();
    test.p_lack_of_fit =
        quadratic({ratio(means.data, left.data.colwise().squaredNorm())[0], ratio(means.draws, squares)});
  }
  test.p = fit_maximum(largest_z).p(data_z);
  return test;
}

}  // namespace fathom
