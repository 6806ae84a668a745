// The explanations that are weighed against each other, each with its log posterior.
#pragma once

#include <vector>

#include "diagnosis/statistics/ambiguity.h"
#include "diagnosis/statistics/case.h"

namespace fathom {

/// Sets of effects by their signatures alone, likeliest first.
std::vector<Hypothesis> screened(const Case& c);

/// The likeliest sets, fitted with the model itself; the empty one among them, likeliest first.
std::vector<Refit> likeliest_fits(const Case& c, const std::vector<Hypothesis>& hypotheses);

/// Those fits, alone and beside something unknown, and what was not worth a fit but cannot be excluded.
std::vector<Option> options_of(const Case& c, const std::vector<Hypothesis>& hypotheses,
                               const std::vector<Refit>& fits);

}  // namespace fathom
