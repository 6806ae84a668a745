#include "diagnosis/decision/held_out.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

#include "core/dense.h"
#include "core/rng.h"
#include "diagnosis/statistics/groups.h"
#include "diagnosis/statistics/problem.h"

namespace fathom {

namespace {

std::vector<Eigen::Index> rows_in(const std::vector<int>& folds, int fold) {
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < folds.size(); ++i)
    if (folds[i] == fold) rows.push_back(static_cast<Eigen::Index>(i));
  return rows;
}

/// Some rows, given the others.
struct Fold {
  std::vector<Eigen::Index> rows;
  Eigen::LLT<Eigen::MatrixXd> precision;  ///< inverse of their covariance
  Eigen::MatrixXd left;                   ///< of jacobian and residual, what the others do not predict by its errors
  Eigen::VectorXd parameters;             ///< by the others' fit
};

// With P the inverse of the covariance, the other folds O predict what this one, F, has of any x but P_FF⁻¹ (P x)_F,
// which has the covariance P_FF⁻¹; and x_Oᵀ Σ_OO⁻¹ y_O = xᵀ P y − (P x)_Fᵀ P_FF⁻¹ (P y)_F: one inverse serves all
// folds.
template <class Use>
void for_each_fold(const LinearFit& fit, const std::vector<int>& folds, const Use& use) {
  const Covariance& covariance = fit.covariance;
  const Eigen::Index n = fit.residual.size(), parameters = fit.jacobian.cols();
  const Eigen::MatrixXd root = covariance.whiten(Eigen::MatrixXd::Identity(n, n));  // P = rootᵀ root
  Eigen::MatrixXd all(n, parameters + 1);
  all << fit.jacobian, fit.residual;
  const Eigen::MatrixXd weighted = covariance.factor.solve(all), squares = all.transpose() * weighted;
  for (int fold = 0; fold < kFolds; ++fold) {
    Fold one{rows_in(folds, fold), {}, {}, Eigen::VectorXd(parameters)};
    if (one.rows.empty() || one.rows.size() == folds.size()) continue;
    const Eigen::MatrixXd own = root(Eigen::all, one.rows), of_fold = weighted(one.rows, Eigen::all);
    one.precision.compute(own.transpose() * own);
    one.left = one.precision.solve(of_fold);
    const Eigen::MatrixXd of_others = squares - of_fold.transpose() * one.left;
    Eigen::MatrixXd G = of_others.topLeftCorner(parameters, parameters);
    G.diagonal() += fit.prior;
    if (parameters > 0) one.parameters = G.llt().solve(of_others.col(parameters).head(parameters));
    use(one);
  }
}

}  // namespace

LinearFit linear_fit(const Covariance& covariance, const Problem& problem, const Refit& fit) {
  const auto unwhitened = [&](const Eigen::MatrixXd& x) -> Eigen::MatrixXd {
    if (x.cols() == 0) return x;  // Eigen's product would look at its first number
    return covariance.factor.matrixL() * x;
  };
  LinearFit linear{covariance, {}, {}, {}, {}};
  const Leeway leeway = leeway_beside(problem, fit.hypothesis.effects, fit.hypothesis.parameters);
  if (leeway.along.cols() > 0) {
    const Eigen::MatrixXd own = unwhitened(leeway.along * leeway.variance.cwiseSqrt().asDiagonal());
    linear.covariance.total += own * own.transpose();
    linear.covariance.factor.compute(linear.covariance.total);
  }
  linear.jacobian = unwhitened(fit.jacobian);
  linear.residual = unwhitened(problem.residual - fit.change + fit.jacobian * fit.hypothesis.parameters);
  linear.prior = prior_precisions(fit.hypothesis.parameters);
  Eigen::Index first = 0;
  for (const int effect : fit.hypothesis.effects) {
    linear.columns.emplace_back();
    for (std::size_t k = 0; k < problem.columns[effect].size(); ++k) linear.columns.back().push_back(first++);
  }
  return linear;
}

std::vector<int> deal_folds(const std::vector<Observation>& observations, std::uint64_t seed) {
  Groups units = group_by(observations, pour_key);
  const bool has_desk = std::any_of(units.of.begin(), units.of.end(), [](int unit) { return unit < 0; });
  if (units.count < 2 * kFolds || has_desk) {
    const bool by_pours = units.count >= 2 * kFolds;
    units = group_by(observations, [&](const Observation& o) {
      const std::string pour = pour_key(o);
      return by_pours && !pour.empty() ? pour : placement_key(o);
    });
  }
  const auto members = units.members();
  const auto order_of = [&](int unit) {
    const Factors& f = observations[members[unit][0]].factors;
    return std::tuple(f.liquid, f.fill_mm, f.distance_mm, f.lateral_mm, unit);
  };
  std::vector<int> order(units.count);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return order_of(a) < order_of(b); });

  std::vector<int> fold_of_unit(units.count);
  std::array<int, kFolds> round{};
  for (int position = 0; position < units.count; ++position) {
    if (position % kFolds == 0) {
      std::iota(round.begin(), round.end(), 0);
      Rng rng(seed, position);
      for (int k = kFolds - 1; k > 0; --k) std::swap(round[k], round[rng.below(static_cast<std::uint32_t>(k + 1))]);
    }
    fold_of_unit[order[position]] = round[position % kFolds];
  }
  std::vector<int> folds;
  for (const int unit : units.of) folds.push_back(fold_of_unit[unit]);
  return folds;
}

HeldOut held_out(const LinearFit& fit, const std::vector<int>& folds) {
  HeldOut result{Eigen::VectorXd::Zero(fit.residual.size()), fit.covariance.total.diagonal()};
  for_each_fold(fit, folds, [&](const Fold& fold) {
    const Eigen::Index parameters = fold.parameters.size(), count = fold.left.rows();
    result.residual(fold.rows) = fold.left.col(parameters);
    if (parameters > 0) result.residual(fold.rows) -= fold.left.leftCols(parameters) * fold.parameters;
    result.variance(fold.rows) = fold.precision.solve(Eigen::MatrixXd::Identity(count, count)).diagonal();
  });
  return result;
}

std::vector<double> confirmations(const LinearFit& fit, const std::vector<int>& folds) {
  std::vector<double> sums(fit.columns.size(), 0.0), squares = sums, result;
  for_each_fold(fit, folds, [&](const Fold& fold) {
    const Eigen::MatrixXd whitened = fold.precision.matrixU() * fold.left;
    for (std::size_t e = 0; e < sums.size(); ++e) {
      std::vector<Eigen::Index> others;
      for (std::size_t k = 0; k < sums.size(); ++k)
        if (k != e) others.insert(others.end(), fit.columns[k].begin(), fit.columns[k].end());
      const Eigen::MatrixXd span = orthonormal(whitened(Eigen::all, others));
      Eigen::VectorXd predicted = whitened(Eigen::all, fit.columns[e]) * fold.parameters(fit.columns[e]);
      if (span.cols() > 0) predicted -= span * (span.transpose() * predicted);
      sums[e] += predicted.dot(whitened.col(fold.parameters.size()));
      squares[e] += predicted.squaredNorm();
    }
  });
  for (std::size_t e = 0; e < sums.size(); ++e)
    result.push_back(squares[e] > 0.0 ? sums[e] / std::sqrt(squares[e]) : 0.0);
  return result;
}

}  // namespace fathom
