// The ambiguity set in words, and what it has in common.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/decision/diagnosis.h"
#include "diagnosis/statistics/case.h"
#include "diagnosis/statistics/posterior.h"

namespace fathom {

/// `kinds`: of kinds_of_candidates().
std::vector<Explanation> explanations(const Case& c, const Posterior& posterior, const AmbiguitySet& set,
                                      const std::vector<int>& kinds);

/// Of each candidate a number that the same effect has in all liquids.
std::vector<int> kinds_of_candidates(const Evidence& evidence);

}  // namespace fathom
