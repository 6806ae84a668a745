// How sure a diagnosis has to be.
#pragma once

#include <cstdint>

namespace fathom {

/// Odds at which something is sure: that an effect is needed beside something unknown, or at all, or something at all.
/// Where nothing is wrong, odds like these turn up once in as many measurements at most (Markov's inequality).
inline constexpr double kSureOdds = 20.0;

/// Frozen on the development seeds of bench/diagnosis_statistics.
struct DecisionSettings {
  std::uint64_t seed = 1;
  int pseudo_experiments = 1000;
  double p_discovery = 0.005;    ///< of the largest among all candidates, for each effect beside the others
  double p_confirmation = 0.01;  ///< in groups that had no part in its size
  double p_gap = 0.003;          ///< for calling unknown what no candidate explains
  double delta = 7.0;            ///< of log posterior: explanations that far from the best are left open
};

}  // namespace fathom
