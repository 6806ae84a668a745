// The ambiguity set in words, and what it has in common.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/statistics/ambiguity.h"
#include "diagnosis/statistics/diagnosis.h"
#include "diagnosis/statistics/evidence.h"

namespace fathom {

std::vector<Explanation> explanations(const Evidence& evidence, const AmbiguitySet& set);

/// Of each candidate a number that the same effect has in all liquids.
std::vector<int> kinds_of_candidates(const Evidence& evidence);

/// Whether all explanations are these effects, but for what may be added; of which liquids they are may differ.
bool all_name(const Evidence& evidence, const std::vector<int>& effects, const AmbiguitySet& set);

/// Probability of the class with the model as it is; 0 if none has it.
double probability_of_nothing(const AmbiguitySet& set);

/// The same of the class with something unknown and no effects.
double probability_of_unknown(const AmbiguitySet& set);

}  // namespace fathom
