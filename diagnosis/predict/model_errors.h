// What few rays and direct light leave out of the observations, as errors that many of them share.
#pragma once

#include "diagnosis/statistics/evidence.h"

namespace fathom {

/// By what is shared: region, liquid, place, condition.
std::vector<SharedError> model_errors(const std::vector<Observation>& observations);

/// 1 σ of every prediction: what some hundred rays and the law's mean are off against a whole frame whose noise dithers
/// the law.
Eigen::VectorXd numerical_errors(const std::vector<Observation>& observations);

}  // namespace fathom
