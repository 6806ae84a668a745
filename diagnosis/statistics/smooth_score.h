// A departure that changes smoothly with distance, fill and place, without a formula for it: a Gaussian process.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnosis/statistics/covariance.h"
#include "diagnosis/statistics/evidence.h"

namespace fathom {

/// n × r, its square is the process's covariance: squared exponential in fill, distance and lateral (each over the
/// length of its range), half shared between liquids and between regions, apart for each observable, as large as the
/// errors of a single observation. Pivoted Cholesky (Harbrecht, Peters & Schneider 2012), r ≤ 60. Not whitened.
Eigen::MatrixXd smooth_factor(const Evidence& evidence, const Covariance& covariance);

/// Log Bayes factor for a smooth departure, averaged over its size: `residual` and `smooth` whitened, after what is
/// explained otherwise was projected out of both.
double smooth_log_evidence(const Eigen::MatrixXd& smooth, const Eigen::VectorXd& residual);

/// The process's mean given the residual, at its most likely size, for each observation: F a² (…)⁻¹, not whitened.
Eigen::VectorXd smooth_map(const Eigen::MatrixXd& factor, const Eigen::MatrixXd& smooth,
                           const Eigen::VectorXd& residual);

}  // namespace fathom
