#include "sim/sensor/dot_likeness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "core/simd.h"
#include "sim/sensor/match.h"

namespace fathom {
namespace {

/// Odd columns from one on and the even ones after them, of kDotRows rows.
struct DotRows {
  const float *odd, *even;
  std::ptrdiff_t stride;
};

inline __attribute__((always_inline)) void load_row(const DotRows& dots, int y, Float8& columns) {
  static_assert(kDotColumns == 8);
  std::memcpy(&columns, dots.odd + y * dots.stride, sizeof(columns) / 2);
  std::memcpy(reinterpret_cast<float*>(&columns) + kDotColumns / 2, dots.even + y * dots.stride, sizeof(columns) / 2);
}

inline __attribute__((always_inline)) float sum_of(const Float8& lanes) {
  float sum = 0.0f;
  for (int k = 0; k < 8; ++k) sum += lanes[k];
  return sum;
}

FATHOM_SIMD_CLONES
Likeness likeness(const DotRows& live, const DotRows& value, const DotRows& slope, float rest_px) {
  constexpr float kCount = kDotColumns * kDotRows;
  Float8 seen{}, expected{}, seen_seen{}, both{}, expected_expected{};
  for (int y = 0; y < kDotRows; ++y) {
    Float8 a, b, c;
    load_row(live, y, a), load_row(value, y, b), load_row(slope, y, c);
    b += rest_px * c;
    seen += a, expected += b;
    seen_seen += a * a, both += a * b, expected_expected += b * b;
  }
  const float mean = sum_of(seen) / kCount, expected_mean = sum_of(expected) / kCount;
  const float contrast = sum_of(seen_seen) - kCount * mean * mean;
  const float expected_contrast = sum_of(expected_expected) - kCount * expected_mean * expected_mean;
  const float covariance = sum_of(both) - kCount * mean * expected_mean;
  return {contrast, covariance / std::sqrt(std::max(contrast * expected_contrast, 1e-6f))};
}

}  // namespace

Likeness dot_likeness(const SensorModel& sensor, const SplitColumns<float>& paired, const Reference& reference, int x,
                      int y, float disparity) {
  const ReferenceShift even = reference_shift(disparity), odd = even.odd();
  const int column = std::clamp(x - kDotColumns / 4, 0, sensor.width - kDotColumns / 2 - 1);
  const int row = std::clamp(sensor.ir_first_row() / 2 + y - kDotRows / 2, 0, paired.even.height() - kDotRows);
  const int reference_column = column + reference.margin_px + even.whole;
  if (reference_column < 0 || reference_column + kDotColumns > reference.value[0].width()) return {};
  const auto dots = [&](const Image<float>& odd_columns, int first_odd, const Image<float>& even_columns,
                        int first_even) {
    return DotRows{odd_columns.row(row) + first_odd, even_columns.row(row) + first_even + 1, even_columns.width()};
  };
  const auto shifted = [&](const std::array<Image<float>, kPhases>& phases) {
    return dots(phases[odd.phase], column + reference.margin_px + odd.whole, phases[even.phase], reference_column);
  };
  return likeness(dots(paired.odd, column, paired.even, column), shifted(reference.value), shifted(reference.slope),
                  even.rest_px);
}

}  // namespace fathom
