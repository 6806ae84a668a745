// Linear least squares with bounds, for a handful of unknowns.
#pragma once

#include <Eigen/Core>

namespace fathom {

/// Minimises xᵀ G x / 2 − bᵀ x for lower ≤ x ≤ upper, G positive definite: the free solution if it lies within,
/// otherwise coordinate by coordinate, and all free ones together, until nothing moves. Not by Ceres 2.1: that takes
/// hundreds of times as long, where the screening solves a hundred thousand of these, and stops short of the minimum
/// where bounds hold (bench/least_squares).
Eigen::VectorXd box_least_squares(const Eigen::MatrixXd& G, const Eigen::VectorXd& b, const Eigen::VectorXd& lower,
                                  const Eigen::VectorXd& upper);

}  // namespace fathom
