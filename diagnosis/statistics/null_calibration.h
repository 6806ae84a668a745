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

/// The largest of many correlated |z|, as if there were `tests` independent ones of Student's t: the trials factor of
/// Gross & Vitells (2010), with tails as thick as an uncertain covariance makes them.
struct MaximumTail {
  double tests = 1.0, dof = 1e3;
  double p(double statistic) const;
};
MaximumTail fit_maximum(const Eigen::VectorXd& draws);

}  // namespace fathom
