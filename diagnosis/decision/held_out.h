// Predictions of observations by a fit to the others.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "diagnosis/statistics/evidence.h"
#include "diagnosis/statistics/refit.h"

namespace fathom {

/// A set of effects at its fit, as a linear model of the observations, not whitened: residual ≈ jacobian · parameters +
/// errors.
struct LinearFit {
  Covariance covariance;  ///< of errors, and of what comes with the effects and nobody predicts
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;                        ///< per prior scale
  Eigen::VectorXd prior;                           ///< precision of each parameter
  std::vector<std::vector<Eigen::Index>> columns;  ///< of each effect
};

LinearFit linear_fit(const Covariance& covariance, const Problem& problem, const Refit& fit);

inline constexpr int kFolds = 6;

/// The fold 0 … kFolds-1 of every observation. Whole pours go together where there are at least twice as many as folds,
/// else whole placements. They are ordered by liquid, fill, distance and lateral and dealt out in shuffled rounds, so
/// that every fold has something of everything.
std::vector<int> deal_folds(const std::vector<Observation>& observations, std::uint64_t seed);

/// Fits of the parameters without some rows, with everything needed to predict these: for gaps on held-out groups.
struct HeldOut {
  Eigen::VectorXd residual;  ///< of every observation, by the fit of effects and nuisances to the other folds
  Eigen::VectorXd variance;  ///< that it should have
};
HeldOut held_out(const LinearFit& fit, const std::vector<int>& folds);

/// z of each effect in folds that had no part in finding its size: along what the other folds' fit predicts there, with
/// the other effects free, all folds together by their information. Standard normal where the effect is absent.
std::vector<double> confirmations(const LinearFit& fit, const std::vector<int>& folds);

}  // namespace fathom
