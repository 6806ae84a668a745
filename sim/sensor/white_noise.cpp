#include "sim/sensor/white_noise.h"

#include <bit>
#include <cstdint>

#include "core/simd.h"

namespace fathom {

FATHOM_SIMD_CLONES
void white_noise(Rng rng, float unit, float* values, int count) {
  for (int i = 0; i < count; i += 2) {
    const std::uint64_t bits = rng.bits();
    values[i] = unit * static_cast<float>(std::popcount(bits >> 32) - 16);
    if (i + 1 < count) values[i + 1] = unit * static_cast<float>(std::popcount(bits & 0xffffffffULL) - 16);
  }
}

}  // namespace fathom
