// What a test statistic does when nothing is wrong, from pseudo-experiments, continued beyond what they reach.
#pragma once

#include <Eigen/Core>

namespace fathom {

/// A sum of squares of correlated normals as a scaled χ² of the same mean and variance (Satterthwaite 1946).
struct QuadraticTail {
  double scale = 1.0, dof = 1.0;
  double p(double statistic) const;
};
QuadraticTail fit_quadratic(const Eigen::VectorXd& draws);

/// The largest of many correlated normals, as if there were `tests` independent ones: the trials factor of Gross &
/// Vitells (2010).
struct MaximumTail {
  double tests = 1.0;
  double p(double statistic) const;
  /// The statistic that has this p.
  double quantile(double p) const;
};
MaximumTail fit_maximum(const Eigen::VectorXd& draws);

/// The standard normal |z| with the tail that Student's |t| of `dof` degrees of freedom has (Wallace 1959; within 0.03
/// from 5 degrees of freedom and up to |t| = 6).
double normal_score(double t, double dof);

}  // namespace fathom
