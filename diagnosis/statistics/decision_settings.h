// How sure a diagnosis has to be.
#pragma once

#include <cstdint>

namespace fathom {

/// Probability at which one explanation is sure among others, and at which it is sure that something is missing.
inline constexpr double kSure = 0.95;
/// Odds against a model in which nothing is missing. Beforehand they are 2, so where nothing is missing they rise to
/// this in one campaign of fifty at most (Markov's inequality): no more shall name something, or call it unknown,
/// falsely.
inline constexpr double kAlarmOdds = 100.0;

struct DecisionSettings {
  std::uint64_t seed = 1;    ///< by which folds are dealt
  double delta = 7.0;        ///< of log posterior: explanations that far from the best are left open
  double p_where = 0.01;     ///< of a part of the observations that is listed as departing
  double p_excess = 0.0003;  ///< of a session, pour, placement or trial that is listed as differing
};

}  // namespace fathom
