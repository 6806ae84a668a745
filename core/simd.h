// Compiles a hot function for several instruction sets and picks one at start-up. The loops inside are written so that
// every version rounds alike: no reductions across lanes, no fused multiply-add (see cmake/Settings.cmake).
#pragma once

// Sanitizers run before the resolver's relocations are done, so they get the plain version.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define FATHOM_SIMD_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define FATHOM_SIMD_CLONES
#endif

namespace fathom {

/// Eight numbers: half a register of AVX-512, one of AVX2, two of SSE. Arithmetic and comparison go lane by lane.
using Float8 = float __attribute__((vector_size(32)));
using Int8 = int __attribute__((vector_size(32)));  ///< also what comparison gives: −1 where it holds, else 0

/// e^x in each lane, to 4e-7 of it, for x from −87 to 87. Written by hand because Eigen's has one instruction set only,
/// and took two thirds of the time of an image whose dots are out of focus.
inline __attribute__((always_inline)) void exp8(const Float8& x, Float8& result) {
  constexpr float kLog2E = 1.44269504f, kRounds = 12582912.0f;  // 1.5 · 2^23: its last digit is worth 1
  constexpr float kLn2High = 0.693359375f, kLn2Low = -2.12194440e-4f;
  const Float8 whole = (x * kLog2E + kRounds) - kRounds;
  const Float8 r = (x - whole * kLn2High) - whole * kLn2Low;  // at most ½ ln 2
  // Taylor's series, in parts that do not wait for one another: what is left out is less than 1.2e-7.
  const Float8 r2 = r * r, first = r + 1.0f, second = r * (1.0f / 6.0f) + 0.5f;
  const Float8 third = (r * (1.0f / 120.0f) + (1.0f / 24.0f)) + r2 * (1.0f / 720.0f);
  const Float8 series = first + r2 * (second + r2 * third);
  const Int8 exponent = (__builtin_convertvector(whole, Int8) + 127) << 23;
  Float8 power;
  static_assert(sizeof power == sizeof exponent);
  __builtin_memcpy(&power, &exponent, sizeof power);
  result = series * power;
}

/// Lanes n … n + 7 of the sixteen of `low` and `high`. Each compiler has its own name for it.
template <int n>
inline __attribute__((always_inline)) void lanes_from(const Float8& low, const Float8& high, Float8& lanes) {
#ifdef __clang__
  lanes = __builtin_shufflevector(low, high, n, n + 1, n + 2, n + 3, n + 4, n + 5, n + 6, n + 7);
#else
  lanes = __builtin_shuffle(low, high, Int8{n, n + 1, n + 2, n + 3, n + 4, n + 5, n + 6, n + 7});
#endif
}

}  // namespace fathom
