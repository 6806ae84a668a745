// Tails of the distributions that tests need, as accurate far out as near the middle, and sums of probabilities that
// are known by their logarithms.
#pragma once

#include <vector>

namespace fathom {

/// Probability that a standard normal exceeds `z`.
double normal_tail(double z);
/// The z that a standard normal exceeds with probability `p`; p below 1e-300 is taken as that.
double normal_quantile(double p);
/// The t that Student's t of `dof` degrees of freedom exceeds with probability `p`.
double student_quantile(double p, double dof);
/// Probability that χ² of `dof` degrees of freedom exceeds `x`.
double chi_squared_tail(double x, double dof);
/// The standard normal |z| with the tail that Student's |t| of `dof` degrees of freedom has (Wallace 1959; within 0.03
/// from 5 degrees of freedom and up to |t| = 6).
double normal_score(double t, double dof);

/// log Σ exp; there must be one.
double log_sum(const std::vector<double>& logs);

}  // namespace fathom
