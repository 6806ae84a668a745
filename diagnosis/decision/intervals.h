// The effects that are named: how sure each is, and how well its parameters are known.
#pragma once

#include <vector>

#include "diagnosis/decision/diagnosis.h"
#include "diagnosis/statistics/case.h"
#include "diagnosis/statistics/refit.h"

namespace fathom {

/// Of each effect of a fit whose Jacobian was differenced: its parameters' values and 95 % intervals, in their units.
/// What comes in steps has a whole number of them, known to half a step at best.
std::vector<std::vector<NamedParameter>> fitted_parameters(const Case& c, const Refit& fit);

/// The effects of a fit whose Jacobian was differenced, with their parameters and how sure each is. Their probability
/// is left to the posterior.
std::vector<NamedEffect> named_effects(const Case& c, const Refit& fit);

/// Of all effects' parameters in their order, in their units.
std::vector<std::vector<double>> covariance_in_units(const Case& c, const Refit& fit);

}  // namespace fathom
