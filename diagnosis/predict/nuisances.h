// What is uncertain in a campaign and is no effect, with what it does to the observations.
#pragma once

#include "diagnosis/predict/predictor.h"

namespace fathom {

/// The rig's uncertain values (1 σ from the rig, else from uncertain_rig.h), the sensor's pose in each session where
/// there are several, the fill of every pour, the place of every placement, and the matcher's window.
std::vector<Nuisance> nuisances_of(const Predictor& predictor);

/// What recorded the brightness need not have been linear: an exponent of 1 ± 0.5 (encodings for screens have 1 / 2.2)
/// on all that is `predicted` of it.
Nuisance brightness_response(const std::vector<Observation>& observations, const Eigen::VectorXd& predicted);

}  // namespace fathom
