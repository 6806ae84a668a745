// Mistakes in what a laboratory wrote down of its fillings: looked for before any physics, by their exact values.
#pragma once

#include "diagnosis/measurement/read_measurement.h"

namespace fathom {

/// Puts fills in another unit ("unit_error") and liquids whose labels were exchanged in a session ("label_swap") right
/// where the heights then fit far better, leaves out pours that are none of what they are called ("wrong_pour"), and
/// adds that to the mistakes. `model_effects` and `file` as of Predictor.
void put_bookkeeping_right(const Json& model_effects, const std::string& file, Measurement& measurement);

}  // namespace fathom
