// How large the heights' differences are, before and after, in all and by stratum, fitted and held out.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/decision/diagnosis.h"
#include "diagnosis/decision/held_out.h"
#include "diagnosis/statistics/case.h"
#include "diagnosis/statistics/refit.h"

namespace fathom {

/// Before: as predicted. After: with the effects, and with nuisances as the (other) data want them within their priors.
void measure_gaps(const Case& c, const Refit& fit, Diagnosis& diagnosis);

/// The heights of one level of one factor: whether effects that were fitted at some distances, or to some liquids, hold
/// at another.
struct LeftOutLevel {
  std::string stratum;  ///< "distance_mm=400"
  GapSize gap;          ///< after: predicted by a fit to all other levels
};

/// Each liquid and each distance in turn, where the effects are seen at the others as well.
std::vector<LeftOutLevel> left_out_levels(const Evidence& evidence, const LinearFit& fit);

}  // namespace fathom
