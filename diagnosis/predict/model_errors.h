// What few rays and direct light leave out of the observations, as errors that many of them share.
#pragma once

#include <string_view>

#include "diagnosis/measurement/laboratory_rig.h"
#include "diagnosis/statistics/evidence.h"

namespace fathom {

/// By what is shared: region, liquid, place, condition; last those of each view of a desk by itself.
std::vector<SharedError> model_errors(const std::vector<Observation>& observations, const LaboratoryRig& rig);

/// Of an effect: what comes with it and no model foretells, where light passes a liquid of the nominal model.
OwnErrors effect_errors(std::string_view id, const std::vector<Observation>& observations,
                        const std::vector<bool>& sees_through);

/// 1 σ of every prediction by itself, beside the errors that observations share.
Eigen::VectorXd numerical_errors(const std::vector<Observation>& observations);

}  // namespace fathom
