// Randomness keyed by what it is for, not by who asks first: the same bytes for any number of threads.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace fathom {

/// SplitMix64's finaliser (Steele, Lea & Flood 2014): a bijection of 64 bits that passes BigCrush as a counter hash.
constexpr std::uint64_t mix_bits(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// A SplitMix64 stream that starts at a hash of its keys, e.g. Rng(seed, frame, pixel, sample).
class Rng {
 public:
  template <class... Keys>
  explicit Rng(std::uint64_t seed, Keys... keys) : state_(mix_bits(seed)) {
    ((state_ = mix_bits(state_ ^ static_cast<std::uint64_t>(keys))), ...);
  }

  std::uint64_t bits() {
    const std::uint64_t result = mix_bits(state_);
    state_ += 0x9e3779b97f4a7c15ULL;
    return result;
  }

  /// Uniform in [0, 1).
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

  /// Uniform in 0 … n-1 (the bias of the multiply method is below n / 2^32).
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(((bits() >> 32) * n) >> 32); }

  /// Standard normal by Box and Muller; the second value is dropped so that streams stay simple to reason about.
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

  /// Gamma(shape ≥ 1, scale) by Marsaglia & Tsang (2000).
  double gamma(double shape, double scale) {
    const double d = shape - 1.0 / 3.0;
    const double c = 1.0 / std::sqrt(9.0 * d);
    for (;;) {
      const double x = normal();
      const double cube = (1.0 + c * x) * (1.0 + c * x) * (1.0 + c * x);
      if (cube > 0.0 && std::log(1.0 - uniform()) < 0.5 * x * x + d - d * cube + d * std::log(cube))
        return d * cube * scale;
    }
  }

 private:
  std::uint64_t state_;
};

}  // namespace fathom
