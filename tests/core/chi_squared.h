// Pearson's test of counts against what was expected, for samplers against their densities.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

namespace fathom {

/// Value that chi² of `degrees` of freedom exceeds about once in 10 000 times: Wilson & Hilferty's approximation
/// (1931), within 1 % from 5 degrees on.
inline double chi_squared_limit(int degrees) {
  constexpr double kNormal = 3.719;  // exceeded with probability 1e-4
  const double spread = 2.0 / (9.0 * degrees);
  return degrees * std::pow(1.0 - spread + kNormal * std::sqrt(spread), 3.0);
}

struct ChiSquared {
  double value;
  int degrees;  ///< of freedom: groups of bins minus one
  bool passes() const { return value < chi_squared_limit(degrees); }
};

/// chi² of counts against expected counts of the same sum. Bins are put together in the order of their expectation
/// until each group expects at least 5, as the test demands.
inline ChiSquared chi_squared(const std::vector<double>& counts, const std::vector<double>& expected) {
  assert(counts.size() == expected.size());
  constexpr double kLeastExpected = 5.0;
  std::vector<std::size_t> order(counts.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return expected[a] < expected[b]; });
  ChiSquared result{0.0, -1};
  double found = 0.0, wanted = 0.0;
  for (const std::size_t bin : order) {
    found += counts[bin];
    wanted += expected[bin];
    if (wanted < kLeastExpected) continue;
    result.value += (found - wanted) * (found - wanted) / wanted;
    ++result.degrees;
    found = wanted = 0.0;
  }
  return result;
}

}  // namespace fathom
