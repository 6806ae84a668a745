// What few rays and direct light leave out of the observations, as errors that many of them share.
#pragma once

#include "diagnosis/statistics/evidence.h"

namespace fathom {

/// One nuisance for each observable, region and group of observations with the same error of the model.
std::vector<Nuisance> model_errors(const std::vector<Observation>& observations);

/// 1 σ of every prediction: what some hundred rays and the law's mean are off against a whole frame whose noise dithers
/// the law.
Eigen::VectorXd numerical_errors(const std::vector<Observation>& observations);

}  // namespace fathom
