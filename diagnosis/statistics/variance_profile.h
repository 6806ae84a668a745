// How likely a residual is when the variances of its errors are not known exactly.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "diagnosis/statistics/covariance.h"

namespace fathom {

/// The covariance may be wrong in one of its parts: a variance component as a whole, one pour, placement or observation
/// that is worse than its like, or the stated σ of all nuisances. Along the eigenvectors of a part (whitened, of share
/// λ in the variance) a residual has projections z. If the part's variance is `a` times as large, the likelihood
/// changes by the factor Π (1 + (a−1) λ)^(−1/2) exp(z² (1 − 1 / (1 + (a−1) λ)) / 2). That is averaged over a, evenly in
/// log a; of stated σ and of errors of the model more is known beforehand, as if found with some degrees of freedom. So
/// the tails are those of Student's t: what errors of few degrees of freedom may have made is no evidence of an effect.
class VarianceProfile {
 public:
  explicit VarianceProfile(const Covariance& covariance);

  /// Log of the mean factor, beside −|residual|² / 2, of each column of the residuals (n × m). Many at once take a
  /// fraction of the time that they take one by one.
  Eigen::VectorXd log_factors(const Eigen::MatrixXd& residuals) const;
  double log_factor(const Eigen::VectorXd& residual) const { return log_factors(residual)[0]; }

 private:
  struct Part {
    Eigen::MatrixXd directions;  ///< n × r, orthonormal
    Eigen::MatrixXd of_squares;  ///< a × r, what each squared projection adds to the log likelihood
    Eigen::VectorXd constants;   ///< a, the rest of it
  };
  /// Of whitened columns, a component's standard deviations; nothing where they hold no variance.
  static std::optional<Part> part_of(const Eigen::MatrixXd& columns, double prior_dof, double most);

  std::vector<Part> parts_;
  Eigen::MatrixXd single_directions_;                     ///< n × singles, unit
  Eigen::ArrayXXd single_of_squares_, single_constants_;  ///< singles × a
};

}  // namespace fathom
