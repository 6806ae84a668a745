#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <vector>

#include "core/parallel.h"
#include "core/simd.h"
#include "sim/sensor/match.h"

namespace fathom {
namespace {

constexpr int kWindow = kRefineWindow;
constexpr float kCount = kWindow * kWindow;

/// One row of the window in one register (or two, or four: the compiler splits it).
using Lanes = float __attribute__((vector_size(kWindow * sizeof(float))));

inline __attribute__((always_inline)) Lanes load(const float* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof(lanes));
  return lanes;
}

/// Adds the lanes pairwise, always in the same order, so that every instruction set rounds alike.
inline __attribute__((always_inline)) float lane_sum(Lanes lanes) {
  float sums[kWindow];
  std::memcpy(sums, &lanes, sizeof(sums));
  for (int half = kWindow / 2; half > 0; half /= 2)
    for (int i = 0; i < half; ++i) sums[i] += sums[i + half];
  return sums[0];
}

/// Σ live · reference and Σ live · gradient over a window.
FATHOM_SIMD_CLONES
void cross_moments(const float* live, std::ptrdiff_t live_stride, const float* reference, const float* gradient,
                   std::ptrdiff_t reference_stride, float* with_reference, float* with_gradient) {
  Lanes r{}, g{};
  for (int row = 0; row < kWindow; ++row) {
    const Lanes i = load(live);
    r += i * load(reference);
    g += i * load(gradient);
    live += live_stride, reference += reference_stride, gradient += reference_stride;
  }
  *with_reference = lane_sum(r);
  *with_gradient = lane_sum(g);
}

/// Sums and sums of squares of a row of windows, by first column.
struct WindowSums {
  std::vector<float> column, column_square, value, square;

  explicit WindowSums(int width) : column(width), column_square(width), value(width), square(width) {}
};

FATHOM_SIMD_CLONES
void add_columns(const float* __restrict row, float* __restrict column, float* __restrict column_square, int width) {
  for (int x = 0; x < width; ++x) {
    column[x] += row[x];
    column_square[x] += row[x] * row[x];
  }
}

FATHOM_SIMD_CLONES
void slide(const float* __restrict column, float* __restrict sums, int count) {
  for (int x = 0; x < count; ++x) {
    float sum = 0.0f;
    for (int i = 0; i < kWindow; ++i) sum += column[x + i];
    sums[x] = sum;
  }
}

void sum_windows(const Image<float>& ir, int first_row, WindowSums& sums) {
  const int width = ir.width();
  std::fill(sums.column.begin(), sums.column.end(), 0.0f);
  std::fill(sums.column_square.begin(), sums.column_square.end(), 0.0f);
  for (int j = 0; j < kWindow; ++j) add_columns(ir.row(first_row + j), sums.column.data(), sums.column_square.data(), width);
  slide(sums.column.data(), sums.value.data(), width - kWindow + 1);
  slide(sums.column_square.data(), sums.square.data(), width - kWindow + 1);
}

class Refiner {
 public:
  Refiner(const SensorModel& sensor, const Image<float>& ir, const Reference& reference)
      : ir_(ir), reference_(reference), least_energy_(static_cast<float>(sensor.matcher.contrast_min * sensor.matcher.contrast_min) * kCount) {}

  /// `sums` belongs to the rows from `first_row` on.
  std::optional<Estimate> refine(int x, int y, int first_row, const WindowSums& sums, float coarse) const {
    // The first step is exact for dots that all moved alike; a second one from nearer by takes in those that did not.
    constexpr float kNearEnough = 0.75f / kPhases;  // [infrared px]
    float moved = 0.0f;
    std::optional<Estimate> estimate = step(x, y, first_row, sums, coarse, moved);
    if (estimate && std::fabs(moved) > kNearEnough) estimate = step(x, y, first_row, sums, estimate->disparity, moved);
    return estimate;
  }

 private:
  std::optional<Estimate> step(int x, int y, int first_row, const WindowSums& sums, float from, float& moved) const {
    const int first_column = std::clamp(2 * x + 1 - kWindow / 2, 0, ir_.width() - kWindow);
    const ReferenceShift shift = reference_shift(from);
    const int column = first_column + 2 * reference_.margin_px + shift.whole;
    if (column < 0 || column >= reference_.moment_columns) return std::nullopt;
    const Image<float>&shifted = reference_.shifted[shift.phase], &gradient = reference_.gradient[shift.phase];
    const float i = sums.value[first_column];
    const float ii = sums.square[first_column] - i * i / kCount;
    if (ii < least_energy_) return std::nullopt;
    float ir, ig;
    cross_moments(ir_.row(first_row) + first_column, ir_.width(), shifted.row(first_row) + column,
                  gradient.row(first_row) + column, shifted.width(), &ir, &ig);
    const WindowMoments& memory = reference_.moments_at(y, column, shift.phase);
    const float a = ir - i * memory.r / kCount, b = ig - i * memory.g / kCount;
    const float rr = memory.rr - memory.r * memory.r / kCount;
    const float rg = memory.rg - memory.r * memory.g / kCount;
    const float gg = memory.gg - memory.g * memory.g / kCount;
    // The correlation of i with r + t g, (a + t b) / √(ii (rr + 2 t rg + t² gg)), has its one maximum at t.
    const float denominator = a * gg - b * rg;
    if (denominator <= 0.0f) return std::nullopt;
    const float t = (b * rr - a * rg) / denominator;
    constexpr float kFarthest = 1.5f;  // [infrared px]; beyond, the derivative says nothing
    if (std::fabs(t) > kFarthest) return std::nullopt;
    moved = t;
    const float energy = rr + 2.0f * t * rg + t * t * gg;
    Estimate estimate;
    estimate.disparity = from + 0.5f * (shift.rest_ir_px - t);
    estimate.correlation = (a + t * b) / std::sqrt(ii * energy);
    estimate.gain = (a + t * b) / energy;
    estimate.bias = (i - estimate.gain * (memory.r + t * memory.g)) / kCount;
    estimate.centre_x = 0.5f * (static_cast<float>(first_column) + memory.centre_x + 0.5f) - (static_cast<float>(x) + 0.5f);
    estimate.centre_y = 0.5f * (memory.centre_y + 0.5f - kWindow / 2);
    return estimate;
  }

  const Image<float>& ir_;
  const Reference& reference_;
  float least_energy_;
};

/// Disparities along one axis through a pixel, NaN outside the image and where nothing matched.
class Profile {
 public:
  Profile(const Image<Estimate>& estimates, int x, int y, int dx, int dy) : estimates_(estimates), x_(x), y_(y), dx_(dx), dy_(dy) {}

  float operator()(int steps) const {
    const int x = x_ + steps * dx_, y = y_ + steps * dy_;
    const bool inside = x >= 0 && x < estimates_.width() && y >= 0 && y < estimates_.height();
    return inside ? estimates_(x, y).disparity : std::numeric_limits<float>::quiet_NaN();
  }
  /// By how much three equidistant disparities around `middle` miss a straight line.
  float bend(int middle, int reach) const {
    return std::fabs((*this)(middle - reach) - 2.0f * (*this)(middle) + (*this)(middle + reach));
  }

 private:
  const Image<Estimate>& estimates_;
  int x_, y_, dx_, dy_;
};

/// Slope of the disparity [px/px] over the longest stretch that is straight; on one side where the other bends away, 0
/// where both do.
float local_slope(const Profile& profile) {
  constexpr float kStraight = 0.20f;  // [px]
  for (const int reach : {7, 4})
    if (profile.bend(0, reach) < kStraight) return (profile(reach) - profile(-reach)) / static_cast<float>(2 * reach);
  constexpr int kHalf = 3;
  const float before = profile.bend(-kHalf, kHalf), after = profile.bend(kHalf, kHalf);
  if (before < kStraight && !(after < before)) return (profile(0) - profile(-2 * kHalf)) / (2 * kHalf);
  if (after < kStraight) return (profile(2 * kHalf) - profile(0)) / (2 * kHalf);
  return 0.0f;
}

}  // namespace

Image<Estimate> refine(const SensorModel& sensor, const Image<float>& ir, const Reference& reference, const Image<float>& coarse) {
  Image<Estimate> estimates(sensor.width, sensor.height);
  const Refiner refiner(sensor, ir, reference);
  // A window needs three quarters of its columns inside the image.
  const int border = sensor.matcher.window_columns / 4;
  const float least_correlation = static_cast<float>(sensor.matcher.correlation_min);
  parallel_ranges(sensor.height, [&](int begin, int end) {
    WindowSums sums(ir.width());
    for (int y = begin; y < end; ++y) {
      const int first_row = window_first_row(sensor, y);
      sum_windows(ir, first_row, sums);
      for (int x = border; x < sensor.width - border; ++x) {
        if (std::isnan(coarse(x, y))) continue;
        const std::optional<Estimate> found = refiner.refine(x, y, first_row, sums, coarse(x, y));
        if (found && found->correlation >= least_correlation) estimates(x, y) = *found;
      }
    }
  });
  return estimates;
}

void carry_to_pixels(Image<Estimate>& estimates) {
  parallel_ranges(estimates.height(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < estimates.width(); ++x) {
        if (!estimates(x, y).valid()) continue;
        estimates(x, y).slope_x = local_slope(Profile(estimates, x, y, 1, 0));
        estimates(x, y).slope_y = local_slope(Profile(estimates, x, y, 0, 1));
      }
  });
  for (Estimate& estimate : estimates.pixels())
    estimate.disparity -= estimate.slope_x * estimate.centre_x + estimate.slope_y * estimate.centre_y;
}

}  // namespace fathom
