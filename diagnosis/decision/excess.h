// Sessions, pours, placements and trials that differ by more than the laboratory states.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnosis/decision/diagnosis.h"
#include "diagnosis/statistics/covariance.h"
#include "diagnosis/statistics/evidence.h"

namespace fathom {

/// In what a fit leaves: by how much each session differs from the mean of the others, for every deciding observable in
/// mm or degrees, and by how much trials move beyond their noise; by generalised least squares. Besides, pours and
/// placements whose heights scatter more than is stated, by the variance that was estimated of them, and parts of
/// sessions' desks. `residual` is
/// whitened, `explained` (orthonormal, may have no columns) is taken out of it already. Listed are those that chance
/// makes with p < `level`, all that were looked at counted; largest first, in errors.
std::vector<Excess> excess_of(const Evidence& evidence, const Covariance& covariance, const Eigen::VectorXd& residual,
                              const Eigen::MatrixXd& explained, double level);

}  // namespace fathom
