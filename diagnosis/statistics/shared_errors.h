// How large the errors of the model are that observations share, as the data show it beside anything a candidate does.
#pragma once

#include "diagnosis/statistics/evidence.h"
#include "diagnosis/statistics/variance_components.h"

namespace fathom {

/// How well the sizes of a model's errors are known beforehand: as if each had been found with so many degrees of
/// freedom (bench/model_errors.py: from one simulated device to another they differ by a factor of two). No error of
/// the model, and none that a laboratory states, is more than twice as large: what is larger is something that is
/// missing.
inline constexpr double kModelDof = 5.0, kMostOfKnown = 4.0;  ///< the second of the variance

/// The evidence's shared errors, as large as they are thought to be before the data say it.
std::vector<VarianceComponent> expected_shared_errors(const Evidence& evidence);

/// The components of the evidence's shared errors, those of one observable together, by restricted maximum likelihood
/// of what no candidate's sensitivity and no constant can change. `known` (n × n) is the covariance from all else.
/// Where few such contrasts are left, a component stays as large as it was thought to be.
std::vector<ObservableErrors> estimate_shared_errors(const Evidence& evidence, const Eigen::VectorXd& residual,
                                                     const Eigen::MatrixXd& known);

}  // namespace fathom
