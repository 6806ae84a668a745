#include "sim/sensor/surface_fit.h"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/simd.h"

namespace fathom {
namespace {

/// Sums over the neighbours that lie on the surface: their number and first and second moments, and of the differences.
enum Moment { kN, kX, kY, kXX, kXY, kYY, kD, kDX, kDY, kMoments };

inline __attribute__((always_inline)) void sum_moments(const Neighbours& neighbours, const LocalSurface& surface,
                                                       float same_surface, float (&moments)[kMoments]) {
  constexpr int kMiddle = Neighbours::kAlong / 2, kStride = Neighbours::kStride;
  const Float8 dx = static_cast<float>(kStride) * (Float8{0, 1, 2, 3, 4, 5, 6, 7} - static_cast<float>(kMiddle));
  Float8 sums[kMoments] = {};
  for (int row = 0; row < Neighbours::kAlong; ++row) {
    const float dy = static_cast<float>(kStride * (row - kMiddle));
    Float8 there;
    std::memcpy(&there, neighbours.disparity[row], sizeof(there));
    const Float8 difference = there - (surface.disparity + surface.slope_y * dy) - surface.slope_x * dx;
    const Int8 near = (difference <= same_surface) & (difference >= -same_surface);
    const Float8 one = near ? Float8{} + 1.0f : Float8{}, d = near ? difference : Float8{};
    const Float8 x = one * dx, y = one * dy;
    sums[kN] += one, sums[kX] += x, sums[kY] += y;
    sums[kXX] += x * dx, sums[kXY] += x * dy, sums[kYY] += y * dy;
    sums[kD] += d, sums[kDX] += d * dx, sums[kDY] += d * dy;
  }
  for (int k = 0; k < kMoments; ++k) {
    moments[k] = 0.0f;
    for (int lane = 0; lane < 8; ++lane) moments[k] += sums[k][lane];
  }
}

}  // namespace

Neighbours neighbours_of(const Image<float>& framed, int x, int y) {
  Neighbours result;
  for (int j = 0; j < Neighbours::kAlong; ++j) {
    const float* row = framed.row(y + j * Neighbours::kStride) + x;
    for (int i = 0; i < Neighbours::kAlong; ++i) result.disparity[j][i] = row[i * Neighbours::kStride];
    result.disparity[j][Neighbours::kAlong] = std::numeric_limits<float>::quiet_NaN();
  }
  return result;
}

FATHOM_SIMD_CLONES
void fit(const Neighbours& neighbours, LocalSurface& surface) {
  // [px]; the later rounds leave out what lies beyond a crease
  for (const float same_surface : {0.6f, 0.15f, 0.05f}) {
    constexpr float kEnough = 6.0f;
    float m[kMoments];
    sum_moments(neighbours, surface, same_surface, m);
    if (m[kN] < kEnough) break;
    // Normal equations of d = c₀ + c₁ x + c₂ y by cofactors; the sums of whole numbers are exact.
    const float a = m[kXX] * m[kYY] - m[kXY] * m[kXY], b = m[kXY] * m[kY] - m[kX] * m[kYY],
                c = m[kX] * m[kXY] - m[kXX] * m[kY];
    const float determinant = m[kN] * a + m[kX] * b + m[kY] * c;
    if (!(determinant > 1.0f)) break;  // all on one line
    const float d = m[kN] * m[kYY] - m[kY] * m[kY], e = m[kX] * m[kY] - m[kN] * m[kXY],
                f = m[kN] * m[kXX] - m[kX] * m[kX];
    surface.disparity += (a * m[kD] + b * m[kDX] + c * m[kDY]) / determinant;
    surface.slope_x += (b * m[kD] + d * m[kDX] + e * m[kDY]) / determinant;
    surface.slope_y += (c * m[kD] + e * m[kDX] + f * m[kDY]) / determinant;
  }
}

}  // namespace fathom
