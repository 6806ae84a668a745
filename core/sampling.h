// Monte Carlo until the error is small enough: the same numbers for any number of threads.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/estimate.h"

namespace fathom {

struct SamplingPlan {
  std::uint64_t samples = 0;      ///< so many; 0: until the errors below are reached
  std::size_t judged = 0;         ///< how many of the quantities, the first ones, must reach the errors; 0: all
  double relative_error = 0.002;  ///< standard error over value
  double absolute_error = 1e-6;   ///< a smaller standard error is good enough, whatever the value
  std::uint64_t most_work = 2'000'000'000;  ///< gives up beyond, in the units that the sampler counts
  std::function<void(std::uint64_t done, std::uint64_t expected)> report{};  ///< progress in samples; may be empty
};

struct SamplingResult {
  std::vector<Estimate> quantities;
  std::uint64_t samples = 0;
  bool reached = true;  ///< false: gave up before the errors were reached
};

/// Writes the quantities of one sample, whose number is the key of its randomness, and returns the work it took (e.g.
/// scatterings). Called from several threads.
using Sampler = std::function<std::uint64_t(std::uint64_t sample, std::span<double> quantities)>;

/// A judged quantity that was 0 in all of N samples is taken to be known to 1/N.
SamplingResult sample_until(const SamplingPlan& plan, std::size_t quantities, const Sampler& sampler);

}  // namespace fathom
