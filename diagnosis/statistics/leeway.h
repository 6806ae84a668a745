// What comes with an effect and nobody can predict, such as where a foam has its holes: errors of an explanation's own.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace fathom {

/// Variance along some directions, on top of the unit variance that whitened residuals have in all.
struct Leeway {
  Eigen::MatrixXd along;               ///< n × k, orthonormal; no columns: none
  Eigen::VectorXd variance;            ///< along each
  std::optional<double> grows_from{};  ///< as OwnErrors::grow_from
  double log_det = 0.0;                ///< log of the covariance's determinant

  /// Where there is `amount` of what brings it, in typical departures.
  Leeway at(double amount) const;

  /// Whitened columns once more, so that what the leeway allows for counts less.
  Eigen::MatrixXd whiten(const Eigen::MatrixXd& x) const;

  /// The likeliest share that it has in a residual.
  Eigen::VectorXd share_in(const Eigen::VectorXd& residual) const;
};

/// Of independent errors, whitened columns of 1 σ each.
Leeway leeway_of(const Eigen::MatrixXd& errors, std::optional<double> grows_from = {});

/// Of the variance of own errors that is there with `amount` of what brings them, in typical departures.
double share_of_variance(std::optional<double> grows_from, double amount);

}  // namespace fathom
