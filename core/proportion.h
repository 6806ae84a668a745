// How well a proportion is known from counts.
#pragma once

#include "core/range.h"

namespace fathom {

/// Wilson's 95 % interval of the proportion of `hits` in `trials` (Wilson 1927): as long as it should be in the mean,
/// for few trials and proportions of 0 and 1 as well. 0 to 1 of no trials.
Interval wilson_95(int hits, int trials);

/// Clopper and Pearson's 95 % interval (1934), which is exact: it holds the true proportion at least as often as it
/// says.
Interval clopper_pearson_95(int hits, int trials);

}  // namespace fathom
