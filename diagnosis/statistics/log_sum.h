// Sums of probabilities that are known by their logarithms.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace fathom {

/// log Σ exp; there must be one.
inline double log_sum(const std::vector<double>& logs) {
  const double most = *std::max_element(logs.begin(), logs.end());
  if (!std::isfinite(most)) return most;
  double sum = 0.0;
  for (const double log : logs) sum += std::exp(log - most);
  return most + std::log(sum);
}

}  // namespace fathom
