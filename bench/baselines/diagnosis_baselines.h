// What others would do with the same evidence: every observation on its own, no shared errors.
#pragma once

#include <vector>

#include "diagnosis/statistics/evidence.h"

namespace fathom {

/// Effects by number, ascending. Noise is independent, as large as the scatter between equal conditions, or where there
/// are none as that of the repeats.
std::vector<int> greedy_bic(const Evidence& evidence);  ///< forward selection while BIC falls
std::vector<int> lasso_bic(const Evidence& evidence);   ///< Tibshirani 1996 by coordinate descent, λ by BIC
/// The candidate with the largest |correlation| with the residual, if its z exceeds 3.
std::vector<int> largest_correlation(const Evidence& evidence);

}  // namespace fathom
