// What a departure looks like that no candidate explains: a smooth map, a short formula, what it resembles most.
#pragma once

#include <Eigen/Core>

#include "diagnosis/decision/diagnosis.h"
#include "diagnosis/statistics/covariance.h"
#include "diagnosis/statistics/discrepancy.h"
#include "diagnosis/statistics/evidence.h"
#include "diagnosis/statistics/problem.h"

namespace fathom {

/// `residual` whitened, with what was named (the span of `explained`, orthonormal) projected out.
UnknownShape describe_unknown(const Evidence& evidence, const Covariance& covariance, const Problem& problem,
                              const Discrepancy& discrepancy, const Eigen::VectorXd& residual,
                              const Eigen::MatrixXd& explained);

}  // namespace fathom
