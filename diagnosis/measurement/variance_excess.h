// A variance beyond what is known to make one, as an observation in its root's unit.
#pragma once

#include <string>

#include "diagnosis/statistics/evidence.h"

namespace fathom {

struct VarianceExcess {
  double value, error;  ///< error: 1 σ
};

/// The root, negative where that is more which is known to make one; as significant as the variance is, and never less
/// uncertain than the root of its error. `estimates`: how many numbers the variance is of.
Observation root_of(const VarianceExcess& excess, std::string observable, Factors factors, int estimates);

}  // namespace fathom
