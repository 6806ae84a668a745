// Every set of up to four effects, from the sensitivities' Gram matrix alone.
#pragma once

#include <vector>

#include "diagnosis/statistics/problem.h"

namespace fathom {

/// Most effects at once.
inline constexpr std::size_t kLargestSet = 4;

/// The best `keep` sets of each size 1 … `largest` by log evidence, each size best first. Sets in which an effect's
/// best value is none are left out: the smaller set is there.
std::vector<Hypothesis> screen(const Problem& problem, int keep, std::size_t largest = kLargestSet);

}  // namespace fathom
