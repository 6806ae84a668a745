// Two tiers of observations: heights and shapes decide whether there is a gap; the others only help to name what makes
// it.
#pragma once

#include <vector>

#include "diagnosis/decision/diagnosis.h"
#include "diagnosis/statistics/evidence.h"

namespace fathom {

/// Rows of the observations that decide, ascending.
std::vector<Eigen::Index> deciding_rows(const Evidence& evidence);

/// The evidence of these rows alone. Candidates that move none of them are left out.
Evidence deciding_evidence(const Evidence& evidence, const std::vector<Eigen::Index>& rows);

/// The same rows of what `predict` says.
Predict predict_rows(const Predict& predict, const std::vector<Eigen::Index>& rows);

/// Of a diagnosis by all observations and one by those that decide. The first where it is `none` or `named`, or the
/// second `insufficient`; where it finds something unknown, if the second does too; where it is `ambiguous`, unless the
/// second is `none`. Otherwise the second, with the first's residuals of the other observations and what of these
/// departs all the same in `beside`. `deciding`: the rows of the second.
Diagnosis joined_tiers(Diagnosis by_all, Diagnosis by_deciding, const Evidence& evidence,
                       const std::vector<Eigen::Index>& deciding);

}  // namespace fathom
