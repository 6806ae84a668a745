// A pour that holds something else than its label says, beside others that hold what it says.
#pragma once

#include "diagnosis/measurement/read_measurement.h"

namespace fathom {

/// A pour is what stands between two other fillings in a session's time. Where the heights of at least two placements
/// of one, all alike, are off by more than 5 mm and ten times what pours scatter by from those of at least twice as
/// many pours of the same filling, it is left out and a mistake ("wrong_pour") is added. `model_effects` and `file` as
/// of Predictor.
void leave_out_odd_pours(const Json& model_effects, const std::string& file, Measurement& measurement);

}  // namespace fathom
