// What others would do with the same evidence.
#pragma once

#include <vector>

#include "diagnosis/statistics/evidence.h"

namespace fathom {

/// Effects by number, ascending. Where nothing else is said noise is independent, as large as the scatter between equal
/// conditions, or where there are none as that of the repeats.
std::vector<int> greedy_bic(const Evidence& evidence);  ///< forward selection while BIC falls
/// The same by generalised least squares, with the covariance of errors that the diagnosis has.
std::vector<int> gls_bic(const Evidence& evidence);
std::vector<int> lasso_bic(const Evidence& evidence);  ///< Tibshirani 1996 by coordinate descent, λ by BIC
/// The candidate with the largest |correlation| with the residual, if its z exceeds 3.
std::vector<int> largest_correlation(const Evidence& evidence);

}  // namespace fathom
