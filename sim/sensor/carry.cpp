#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "core/simd.h"
#include "sim/sensor/match.h"

namespace fathom {
namespace {

constexpr int kFar = 7;  ///< [px] reach of the longest slope

/// Slope of the disparity [px/px] over the longest stretch that is straight: 7 or 4 pixels to both sides, else 6 to the
/// one side where it is straighter, else 0. `at` is the pixel and `step` the distance to the next one along the axis.
/// NaN (no match) is never straight.
inline __attribute__((always_inline)) float local_slope(const float* at, std::ptrdiff_t step) {
  constexpr float kStraight = 0.20f;  // [px]
  const float here = at[0];
  const float before = std::fabs(at[-6 * step] - 2.0f * at[-3 * step] + here);
  const float after = std::fabs(here - 2.0f * at[3 * step] + at[6 * step]);
  const float near = std::fabs(at[-4 * step] - 2.0f * here + at[4 * step]);
  const float far = std::fabs(at[-7 * step] - 2.0f * here + at[7 * step]);
  float slope = after < kStraight ? (at[6 * step] - here) * (1.0f / 6.0f) : 0.0f;
  slope = (before < kStraight) & !(after < before) ? (here - at[-6 * step]) * (1.0f / 6.0f) : slope;
  slope = near < kStraight ? (at[4 * step] - at[-4 * step]) * (1.0f / 8.0f) : slope;
  return far < kStraight ? (at[7 * step] - at[-7 * step]) * (1.0f / 14.0f) : slope;
}

FATHOM_SIMD_CLONES
void carry_row(const float* disparity, std::ptrdiff_t stride, const float* centre_x, const float* centre_y,
               float* slope_x, float* slope_y, float* carried, int width) {
#pragma GCC ivdep
  for (int x = 0; x < width; ++x) {
    const float across = local_slope(disparity + x, 1), down = local_slope(disparity + x, stride);
    slope_x[x] = across, slope_y[x] = down;
    carried[x] = disparity[x] - across * centre_x[x] - down * centre_y[x];
  }
}

}  // namespace

void carry_to_pixels(Estimates& estimates) {
  const int width = estimates.disparity.width(), height = estimates.disparity.height();
  Image<float> framed(width + 2 * kFar, height + 2 * kFar, std::numeric_limits<float>::quiet_NaN());
  for (int y = 0; y < height; ++y) std::copy_n(estimates.disparity.row(y), width, framed.row(y + kFar) + kFar);
  parallel_rows(height, [&](int y) {
    carry_row(framed.row(y + kFar) + kFar, framed.width(), estimates.centre_x.row(y), estimates.centre_y.row(y),
              estimates.slope_x.row(y), estimates.slope_y.row(y), estimates.disparity.row(y), width);
  });
}

}  // namespace fathom
