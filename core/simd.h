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
