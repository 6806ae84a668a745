#include "diagnosis/measurement/variance_excess.h"

#include <algorithm>
#include <cmath>

namespace fathom {

Observation root_of(const VarianceExcess& excess, std::string observable, Factors factors, int estimates) {
  Observation root;
  root.observable = std::move(observable);
  root.factors = std::move(factors);
  root.value = std::copysign(std::sqrt(std::abs(excess.value)), excess.value);
  root.repeats = estimates;
  const double error = std::min(std::sqrt(excess.error), excess.error / std::max(std::abs(root.value), 1e-12));
  root.repeat_sd = error * std::sqrt(static_cast<double>(estimates));
  return root;
}

}  // namespace fathom
