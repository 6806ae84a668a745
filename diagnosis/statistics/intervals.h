// How well the parameters of named effects are known.
#pragma once

#include <vector>

#include "diagnosis/statistics/choose.h"

namespace fathom {

/// Fills in the values of the effects' parameters with their 95 % intervals, in the parameters' units. What comes in
/// steps has a whole number of them, known to half a step at best.
void add_parameters(const Case& c, Choice& choice);

/// Of all effects' parameters in their order, in their units.
std::vector<std::vector<double>> covariance_in_units(const Case& c, const Choice& choice);

}  // namespace fathom
