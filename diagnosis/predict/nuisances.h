// What is uncertain in a campaign and is no effect, with what it does to the observations.
#pragma once

#include "diagnosis/predict/predictor.h"

namespace fathom {

/// The rig's uncertain values (1 σ from the rig, else from uncertain_rig.h), the sensor's pose in each session where
/// there are several, the fill of every pour, the place of every placement, and the matcher's window.
std::vector<Nuisance> nuisances_of(const Predictor& predictor);

}  // namespace fathom
