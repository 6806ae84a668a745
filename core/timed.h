// How long a piece of work takes.
#pragma once

#include <chrono>

namespace fathom {

/// Runs `work` and adds its wall-clock time to `seconds`.
template <class Work>
auto timed(double& seconds, Work work) {
  const auto start = std::chrono::steady_clock::now();
  auto result = work();
  seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace fathom
