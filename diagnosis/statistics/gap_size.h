// How large the heights' differences are, before and after, in all and by stratum, fitted and held out.
#pragma once

#include "diagnosis/statistics/case.h"
#include "diagnosis/statistics/diagnosis.h"

namespace fathom {

/// Before: as predicted. After: with the effects, and with nuisances as the (other) data want them within their priors.
void measure_gaps(const Case& c, const Refit& fit, Diagnosis& diagnosis);

}  // namespace fathom
