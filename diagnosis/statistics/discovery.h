// How much larger than chance an effect is, given that the largest of many candidates was looked for.
#pragma once

#include <Eigen/Core>

#include "diagnosis/statistics/null_calibration.h"
#include "diagnosis/statistics/problem.h"

namespace fathom {

/// |z| of an estimate with k parameters, whose variance is known to `dof` degrees of freedom: that of a normal with the
/// same two-sided p as χ²_k.
double equivalent_z(double chi_squared, Eigen::Index parameters, double dof);

/// What one candidate can explain.
struct CandidateSpace {
  Eigen::MatrixXd basis;  ///< orthonormal span of its whitened signatures
  double dof = 1e4;       ///< of the variance in it
};
std::vector<CandidateSpace> candidate_spaces(const Problem& problem, const Covariance& covariance);

/// |z| of a candidate if it is alone; `residual` whitened.
double z_alone(const CandidateSpace& space, const Eigen::VectorXd& residual);

/// Largest |z| of any single candidate in each pseudo-experiment.
MaximumTail discovery_tail(const std::vector<CandidateSpace>& spaces, const Eigen::MatrixXd& draws);

struct EffectSize {
  double z = 0.0;    ///< beside the others, as of a normal
  double dof = 1e4;  ///< of its variance
};

/// |z| of each effect of a fit, beside the others.
std::vector<EffectSize> sizes_beside_others(const Problem& problem, const Covariance& covariance, const Hypothesis& fit,
                                            const Eigen::MatrixXd& jacobian);

}  // namespace fathom
