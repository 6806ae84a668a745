#include "sim/sensor/add_scaled.h"

#include "core/simd.h"

namespace fathom {
namespace {

FATHOM_SIMD_CLONES
void add_row(const float* __restrict row, float scale, float* __restrict sum, int count) {
  for (int i = 0; i < count; ++i) sum[i] += scale * row[i];
}

}  // namespace

void add_scaled(const float* row, float scale, float* sum, int count) { add_row(row, scale, sum, count); }

}  // namespace fathom
