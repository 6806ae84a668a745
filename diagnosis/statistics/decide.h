// From what was measured, what the model predicts and how it could be wrong to what is wrong with it.
#pragma once

#include "diagnosis/statistics/decision_settings.h"
#include "diagnosis/statistics/diagnosis.h"
#include "diagnosis/statistics/evidence.h"
#include "diagnosis/statistics/next_measurement.h"

namespace fathom {

/// The diagnosis. `predict` is asked for some tens of predictions with up to four effects switched on; `designs` are
/// measurements that could be made next, asked for when some explanations are left open.
Diagnosis decide(const Evidence& evidence, const Predict& predict, const Designs& designs = {},
                 const DecisionSettings& settings = {});

}  // namespace fathom
