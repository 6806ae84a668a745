// How large the errors of the model are that observations share, as the data show it beside anything a candidate does.
#pragma once

#include "diagnosis/statistics/evidence.h"
#include "diagnosis/statistics/variance_components.h"

namespace fathom {

/// The components of the evidence's shared errors, those of one observable together, by restricted maximum likelihood
/// of what no candidate's signature and no constant can change. `known` (n × n) is the covariance from all else. Where
/// few such contrasts are left, a component stays as large as it was thought to be.
std::vector<ObservableErrors> estimate_shared_errors(const Evidence& evidence, const Eigen::VectorXd& residual,
                                                     const Eigen::MatrixXd& known);

}  // namespace fathom
