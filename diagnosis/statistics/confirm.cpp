#include "diagnosis/statistics/confirm.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/rng.h"
#include "diagnosis/statistics/distributions.h"
#include "diagnosis/statistics/folds.h"
#include "diagnosis/statistics/groups.h"
#include "diagnosis/statistics/problem.h"

namespace fathom {

namespace {

constexpr int kThirds = 3;
constexpr int kFlips = 1999;
constexpr int kFewestPours = 6;

/// Some rows in units of their errors.
struct Part {
  Eigen::MatrixXd jacobian, residuals;  ///< residual first, then draws
  Eigen::VectorXd prior;                ///< precisions of the parameters

  Part(const Covariance& covariance, const LinearFit& fit, const Eigen::MatrixXd& draws,
       const std::vector<Eigen::Index>& rows)
      : prior(fit.prior) {
    const Eigen::LLT<Eigen::MatrixXd> factor(part(covariance, rows));
    Eigen::MatrixXd all(rows.size(), 1 + draws.cols());
    all << fit.residual(rows), draws(rows, Eigen::all);
    jacobian = factor.matrixL().solve(Eigen::MatrixXd(fit.jacobian(rows, Eigen::all)));
    residuals = factor.matrixL().solve(all);
  }

  /// Parameters × (1 + draws), kept finite by the prior.
  Eigen::MatrixXd parameters() const {
    Eigen::MatrixXd G = jacobian.transpose() * jacobian;
    G.diagonal() += prior;
    return G.llt().solve(jacobian.transpose() * residuals);
  }
};

/// One effect's columns, with all others projected out, and the residuals on them.
struct Sight {
  Eigen::MatrixXd information;  ///< parameters × parameters
  Eigen::MatrixXd projections;  ///< parameters × (1 + draws)

  Sight(const Part& part, const std::vector<Eigen::Index>& own) {
    std::vector<Eigen::Index> others;
    for (Eigen::Index k = 0; k < part.jacobian.cols(); ++k)
      if (std::find(own.begin(), own.end(), k) == own.end()) others.push_back(k);
    const Eigen::MatrixXd basis = orthonormal(part.jacobian(Eigen::all, others));
    Eigen::MatrixXd left = part.jacobian(Eigen::all, own);
    if (basis.cols() > 0) left -= basis * (basis.transpose() * left);
    information = left.transpose() * left;
    projections = left.transpose() * part.residuals;
  }

  /// z of each residual along its own direction (parameters of the effect × residuals).
  Eigen::VectorXd along(const Eigen::MatrixXd& directions) const {
    const Eigen::VectorXd lengths = directions.cwiseProduct(information * directions).colwise().sum();
    const Eigen::VectorXd sums = directions.cwiseProduct(projections).colwise().sum();
    return sums.array() / lengths.array().max(1e-300).sqrt();
  }
};

/// Share of sign patterns over pours that make the effect's sum as large as it is.
double sign_flip(const std::vector<Observation>& observations, const Covariance& covariance, const LinearFit& fit,
                 const Eigen::VectorXd& pattern, std::uint64_t seed) {
  Groups groups = group_by(observations, pour_key);
  if (groups.count < kFewestPours) groups = group_by(observations, placement_key);
  std::vector<double> sums;
  for (const auto& rows : groups.members()) {
    const Eigen::LLT<Eigen::MatrixXd> factor(part(covariance, rows));
    sums.push_back(pattern(rows).dot(factor.solve(Eigen::VectorXd(fit.residual(rows)))));
  }
  double observed = 0.0;
  for (const double sum : sums) observed += sum;
  int as_large = 1;
  for (int flip = 0; flip < kFlips; ++flip) {
    Rng rng(seed, flip);
    double sum = 0.0;
    std::uint64_t bits = 0;
    for (std::size_t g = 0; g < sums.size(); ++g) {
      if (g % 64 == 0) bits = rng.bits();
      sum += (bits >> (g % 64)) & 1 ? sums[g] : -sums[g];
    }
    as_large += std::abs(sum) >= std::abs(observed) * (1.0 - 1e-12);
  }
  return static_cast<double>(as_large) / (kFlips + 1);
}

}  // namespace

std::vector<Confirmation> confirm(const std::vector<Observation>& observations, const Covariance& covariance,
                                  const LinearFit& fit, const Eigen::MatrixXd& draws, const std::vector<double>& dof,
                                  std::uint64_t seed) {
  const std::vector<int> folds = deal_folds(observations, seed);
  const std::size_t effects = fit.columns.size();
  std::vector<Confirmation> result(effects);

  std::vector<Eigen::VectorXd> sums(effects, Eigen::VectorXd::Zero(1 + draws.cols()));
  std::vector<double> weights(effects, 0.0);
  for (int third = 0; third < kThirds; ++third) {
    const std::vector<int> confirming{2 * third, 2 * third + 1};
    const auto rows = rows_in(folds, confirming, true);
    if (rows.empty() || rows.size() == observations.size()) continue;
    const Part tested(covariance, fit, draws, rows);
    const Part discovery(covariance, fit, draws, rows_in(folds, confirming, false));
    const Eigen::MatrixXd found = discovery.parameters();
    for (std::size_t e = 0; e < effects; ++e) {
      const Sight sight(tested, fit.columns[e]);
      const double weight = sight.information.trace();
      const double others = Sight(discovery, fit.columns[e]).information.trace();
      if (others < kInformative * weight) continue;  // what they find of it is rounding
      sums[e] += std::sqrt(weight) * sight.along(found(fit.columns[e], Eigen::all));
      weights[e] += weight;
    }
  }
  for (std::size_t e = 0; e < effects; ++e) {
    if (weights[e] <= 0.0) continue;
    const Eigen::VectorXd z = sums[e] / std::sqrt(weights[e]);
    const Eigen::VectorXd null = z.tail(draws.cols());
    const double sd = std::sqrt((null.array() - null.mean()).square().mean());
    result[e].p = student_tail((z[0] - null.mean()) / sd, dof[e]);
  }

  const Eigen::MatrixXd none(fit.residual.size(), 0);
  std::vector<std::vector<double>> information(effects);
  std::vector<std::vector<bool>> improved(effects);
  for (int fold = 0; fold < kFolds; ++fold) {
    const auto rows = rows_in(folds, {fold}, true);
    if (rows.empty() || rows.size() == observations.size()) continue;
    const Part tested(covariance, fit, none, rows);
    const Eigen::MatrixXd found = Part(covariance, fit, none, rows_in(folds, {fold}, false)).parameters();
    for (std::size_t e = 0; e < effects; ++e) {
      const Sight sight(tested, fit.columns[e]);
      information[e].push_back(sight.information.trace());
      improved[e].push_back(sight.along(found(fit.columns[e], Eigen::all))[0] > 0.0);
    }
  }
  const Part all(covariance, fit, none, rows_in(folds, {}, false));
  const Eigen::VectorXd parameters = all.parameters().col(0);
  for (std::size_t e = 0; e < effects; ++e) {
    double total = 0.0;
    for (const double part_of : information[e]) total += part_of;
    for (std::size_t k = 0; k < information[e].size(); ++k) {
      if (information[e][k] < kInformative * total) continue;
      ++result[e].folds_informative;
      result[e].folds_improved += improved[e][k];
    }
    const Eigen::VectorXd pattern = fit.jacobian(Eigen::all, fit.columns[e]) * parameters(fit.columns[e]);
    LinearFit alone = fit;
    alone.residual -= fit.jacobian * parameters - pattern;
    result[e].p_sign_flip = sign_flip(observations, covariance, alone, pattern, seed);
  }
  return result;
}

// With P the inverse of the covariance, the other folds O predict what this one, F, has of any x but P_FF⁻¹ (P x)_F,
// which has the covariance P_FF⁻¹; and x_Oᵀ Σ_OO⁻¹ y_O = xᵀ P y − (P x)_Fᵀ P_FF⁻¹ (P y)_F: one inverse serves all
// folds.
HeldOut held_out(const Covariance& covariance, const LinearFit& fit, const std::vector<int>& folds) {
  const Eigen::Index n = fit.residual.size(), parameters = fit.jacobian.cols();
  HeldOut result{Eigen::VectorXd::Zero(n), covariance.total.diagonal()};
  const Eigen::MatrixXd root = covariance.whiten(Eigen::MatrixXd::Identity(n, n));  // P = rootᵀ root
  Eigen::MatrixXd all(n, parameters + 1);
  all << fit.jacobian, fit.residual;
  const Eigen::MatrixXd weighted = covariance.factor.solve(all), squares = all.transpose() * weighted;
  for (int fold = 0; fold < kFolds; ++fold) {
    const auto rows = rows_in(folds, {fold}, true);
    if (rows.empty() || rows.size() == folds.size()) continue;
    const Eigen::MatrixXd own = root(Eigen::all, rows), of_fold = weighted(rows, Eigen::all);
    const Eigen::LLT<Eigen::MatrixXd> precision(own.transpose() * own);
    const Eigen::MatrixXd left = precision.solve(of_fold);
    const Eigen::MatrixXd of_others = squares - of_fold.transpose() * left;
    Eigen::MatrixXd G = of_others.topLeftCorner(parameters, parameters);
    G.diagonal() += fit.prior;
    result.residual(rows) = left.col(parameters);
    if (parameters > 0)
      result.residual(rows) -= left.leftCols(parameters) * G.llt().solve(of_others.col(parameters).head(parameters));
    const auto count = static_cast<Eigen::Index>(rows.size());
    result.variance(rows) = precision.solve(Eigen::MatrixXd::Identity(count, count)).diagonal();
  }
  return result;
}

}  // namespace fathom
