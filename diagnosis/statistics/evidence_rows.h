// Part of the evidence.
#pragma once

#include "diagnosis/statistics/evidence.h"

namespace fathom {

/// The evidence of some observations alone.
Evidence evidence_of_rows(const Evidence& evidence, const std::vector<Eigen::Index>& rows);

}  // namespace fathom
