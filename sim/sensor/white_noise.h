// White noise that is all but normal, and cheap, for what is smoothed afterwards.
#pragma once

#include "core/rng.h"

namespace fathom {

/// Each of `count` values is `unit` times the number of ones among 32 random bits, less 16: mean 0, variance 8 unit².
void white_noise(Rng rng, float unit, float* values, int count);

}  // namespace fathom
