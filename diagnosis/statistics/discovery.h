// How much larger than chance an effect is, given that the largest of many candidates was looked for.
#pragma once

#include <Eigen/Core>

#include "diagnosis/statistics/null_calibration.h"
#include "diagnosis/statistics/problem.h"

namespace fathom {

/// |z| of an estimate with k parameters: that of a normal with the same two-sided p as χ²_k.
double equivalent_z(double chi_squared, Eigen::Index parameters);

/// Largest |z| of any single candidate in each pseudo-experiment.
MaximumTail discovery_tail(const Problem& problem, const Eigen::MatrixXd& draws);

/// |z| of each effect of a fit, beside the others.
std::vector<double> z_beside_others(const Problem& problem, const Hypothesis& fit, const Eigen::MatrixXd& jacobian);

}  // namespace fathom
