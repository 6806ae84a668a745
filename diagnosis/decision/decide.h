// From what was measured, what the model predicts and how it could be wrong to what is wrong with it.
#pragma once

#include "diagnosis/decision/diagnosis.h"
#include "diagnosis/decision/next_measurement.h"
#include "diagnosis/statistics/decision_settings.h"
#include "diagnosis/statistics/evidence.h"

namespace fathom {

/// The diagnosis. `predict` is asked for some tens of predictions with up to four effects switched on; `designs` are
/// measurements that could be made next, asked for when some explanations are left open.
Diagnosis decide(const Evidence& evidence, const Predict& predict, const Designs& designs = {},
                 const DecisionSettings& settings = {});

}  // namespace fathom
