// A unit's bias of disparity from views of desks and walls: the posterior of a Gaussian process, the views' planes,
// their own errors and steps of columns taken out.
#pragma once

#include <Eigen/Cholesky>
#include <span>
#include <vector>

#include "diagnosis/unit/bias_field.h"
#include "diagnosis/unit/bias_prior.h"
#include "diagnosis/unit/view_sums.h"

namespace fathom {

/// Wave number [1/px] of the finest waves: a part with the shortest reach has 4 % of its greatest spectral density
/// there.
inline constexpr double kMostWave_per_px = 2.55 / kBiasReaches_px.front();

/// Where the views look settles the operator and the uncertainty; what they read only enters learn(), which is linear.
/// A plane in any view is pose, not bias, so the field has no plane of its own over what was seen.
class BiasLearner {
 public:
  BiasLearner(std::span<const BiasView> layout, const BiasPrior& prior);

  /// `errors_px`: of each view, of each of its cells.
  BiasField learn(std::span<const Eigen::VectorXd> errors_px) const;
  /// Of the errors that the views hold.
  BiasField learn() const;
  /// The inverse of the covariance of all cells' errors, times `errors_px`: in the covariance are the bias, each view's
  /// plane, of any size, its steps of columns and the cells' own errors. Of a prior without states.
  std::vector<Eigen::VectorXd> weighted(std::span<const Eigen::VectorXd> errors_px) const;
  /// Of the errors that the views hold.
  std::vector<Eigen::VectorXd> weighted() const { return weighted(errors_); }
  /// 1 σ of the field that learn() returns [px].
  double sigma(const BiasPoint& point) const;
  /// The posterior error as independent patterns of 1 σ: the `count` that matter most for these points, largest first.
  std::vector<BiasField> error_modes(int count, std::span<const BiasPoint> where) const;

  int states() const { return static_cast<int>(of_state_.size()); }
  /// The prior after one step towards the largest restricted likelihood of the views' errors; with `dof`, towards the
  /// largest posterior, where the variance of each part was `thought` with so many degrees of freedom.
  BiasPrior improved(double dof = 0.0, const BiasPrior& thought = {}) const;

 private:
  struct StateBlock {
    Eigen::LLT<Eigen::MatrixXd> precision;  ///< of the state's factors, all else known; empty without states
    Eigen::MatrixXd cross;                  ///< precision between the shared factors and the state's
  };
  struct Solution {
    Eigen::VectorXd shared;
    std::vector<Eigen::VectorXd> states;
  };
  Solution solve(std::span<const Eigen::VectorXd> errors_px) const;
  BiasFactors factors_of(const Solution& solution) const;
  Eigen::VectorXd shared_at(const BiasPoint& point) const;
  bool has_state(int state) const { return has_states_ && state >= 0 && state < states(); }
  /// Of independent factors of these variances, when the field has none of these planes.
  static Eigen::VectorXd without_planes(const Eigen::VectorXd& variance, const Eigen::MatrixXd& planes);
  /// Each point's error in terms of independent numbers of variance 1, a column each.
  Eigen::MatrixXd whitened(std::span<const BiasPoint> points) const;

  Cosines cosines_;
  BiasPrior prior_;
  ViewSums sums_;
  std::vector<Eigen::VectorXd> errors_;
  bool has_reference_, has_camera_, has_states_;
  Eigen::VectorXd shared_variance_, state_variance_;  ///< of the factors, before anything was seen
  std::vector<StateBlock> of_state_;
  Eigen::LLT<Eigen::MatrixXd> precision_;  ///< of the shared factors, states not known
};

}  // namespace fathom
