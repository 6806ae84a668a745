// Whether effects that were fitted at some distances, or to some liquids, hold at another.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/decision/diagnosis.h"
#include "diagnosis/decision/linear_fit.h"
#include "diagnosis/statistics/evidence.h"

namespace fathom {

/// The heights of one level of one factor.
struct LeftOutLevel {
  std::string stratum;  ///< "distance_mm=400"
  GapSize gap;          ///< after: predicted by a fit to all other levels
};

/// Each liquid and each distance in turn, where the effects are seen at the others as well.
std::vector<LeftOutLevel> left_out_levels(const Evidence& evidence, const LinearFit& fit);

}  // namespace fathom
