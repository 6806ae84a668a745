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

/// Of a diagnosis by all observations and one by those that decide: the first where it is `none` or `insufficient`,
/// where the second finds a gap too, and where what the first finds has a name. Otherwise the second; observables that
/// depart all the same are listed in `beside`. `deciding`: the rows of the second.
Diagnosis joined_tiers(Diagnosis by_all, Diagnosis by_deciding, const Evidence& evidence,
                       const std::vector<Eigen::Index>& deciding);

}  // namespace fathom
