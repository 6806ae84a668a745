// The uncertainty budget of ASME V&V 20-2009, for every condition.
#pragma once

#include <vector>

#include "diagnosis/decision/diagnosis.h"
#include "diagnosis/statistics/covariance.h"
#include "diagnosis/statistics/evidence.h"

namespace fathom {

/// Of the mean over all observations of an observable in a condition: E = measured − predicted, u_D from repeats and
/// variance components, u_input from the nuisances' priors, u_num of the prediction with the errors of the model, u_val
/// from all three.
std::vector<ConditionBudget> uncertainty_budget(const Evidence& evidence, const Covariance& covariance);

/// Of a budget of these observations: by how much a surrogate's predictions differ from those of the evidence becomes
/// u_num, for by that model everything was chosen.
void set_surrogate_differences(const Evidence& evidence, const Eigen::VectorXd& by_surrogate,
                               std::vector<ConditionBudget>& budget);

}  // namespace fathom
