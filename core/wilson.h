// How well a share is known from few trials.
#pragma once

#include <cmath>

namespace fathom {

struct Interval {
  double low, high;
};

/// Wilson's interval for `hits` of `trials`, 95 % (Wilson 1927): right also for few trials and shares of 0 and 1. Of no
/// trials nothing is known: 0 to 1.
inline Interval wilson_95(int hits, int trials) {
  if (trials <= 0) return {0.0, 1.0};
  constexpr double kZ = 1.959964;
  const double n = trials, share = hits / n, z2 = kZ * kZ;
  const double middle = (share + z2 / (2.0 * n)) / (1.0 + z2 / n);
  const double half = kZ * std::sqrt(share * (1.0 - share) / n + z2 / (4.0 * n * n)) / (1.0 + z2 / n);
  return {hits == 0 ? 0.0 : middle - half, hits == trials ? 1.0 : middle + half};
}

}  // namespace fathom
