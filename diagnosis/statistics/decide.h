// From what was measured, what the model predicts and how it could be wrong to what is wrong with it.
#pragma once

#include <cstdint>
#include <vector>

#include "diagnosis/statistics/diagnosis.h"
#include "diagnosis/statistics/evidence.h"
#include "diagnosis/statistics/next_measurement.h"

namespace fathom {

/// Frozen on the development seeds of bench/diagnosis_statistics.
struct DecisionSettings {
  std::uint64_t seed = 1;
  int pseudo_experiments = 1000;
  double p_discovery = 0.005;    ///< of the largest among all candidates, for each effect beside the others
  double p_confirmation = 0.01;  ///< in groups that had no part in its size
  double p_gap = 0.003;          ///< for calling unknown what no candidate explains
  double delta = 6.0;            ///< of log posterior: explanations that far from the best are left open
};

/// The diagnosis. `predict` is asked for some tens of predictions with up to four effects switched on; `designs` are
/// measurements that could be made next, asked for when some explanations are left open.
Diagnosis decide(const Evidence& evidence, const Predict& predict, const Designs& designs = {},
                 const DecisionSettings& settings = {});

}  // namespace fathom
