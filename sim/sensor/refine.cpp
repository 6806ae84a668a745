#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "core/parallel.h"
#include "core/simd.h"
#include "sim/sensor/match.h"

namespace fathom {
namespace {

constexpr int kColumns = 16;  ///< of the window [infrared px]: 8 depth pixels
constexpr int kRows = 7;      ///< of the window [row pairs]: 7 depth pixels
constexpr float kCount = kColumns * kRows;

/// Half a row of the window: one register where there are wide ones; elsewhere the compiler splits it.
constexpr int kLanes = kColumns / 2;
using Lanes = float __attribute__((vector_size(kLanes * sizeof(float))));

inline __attribute__((always_inline)) void load(const float* from, Lanes& lanes) {
  std::memcpy(&lanes, from, sizeof(lanes));
}

/// Adds the lanes pairwise, always in the same order, so that every instruction set rounds alike.
inline __attribute__((always_inline)) float lane_sum(const Lanes& lanes) {
  return ((lanes[0] + lanes[4]) + (lanes[2] + lanes[6])) + ((lanes[1] + lanes[5]) + (lanes[3] + lanes[7]));
}

/// Sums over a window of the live image i, the reference r and its derivative g [1/px].
struct Moments {
  float i, ii, ir, ig, r, g, rr, rg, gg;
  float gg_x, gg_y;  ///< gg weighted by column and by row, both from 0
};

/// Sums over one half of the window's columns.
struct HalfMoments {
  Lanes i{}, ii{}, ir{}, ig{}, r{}, g{}, rr{}, rg{}, gg{}, gg_y{};

  inline __attribute__((always_inline)) void add(const float* live, std::ptrdiff_t live_stride, const float* reference,
                                                 const float* gradient, std::ptrdiff_t reference_stride) {
    const Lanes zero{};
#pragma GCC unroll 1
    for (int row = 0; row < kRows; ++row) {
      Lanes a, b, c;
      load(live, a), load(reference, b), load(gradient, c);
      i += a, ii += a * a, ir += a * b, ig += a * c;
      r += b, g += c, rr += b * b, rg += b * c;
      const Lanes energy = c * c;
      gg += energy, gg_y += energy * (zero + static_cast<float>(row));
      live += live_stride, reference += reference_stride, gradient += reference_stride;
    }
  }
};

FATHOM_SIMD_CLONES
void sum_window(const float* live, std::ptrdiff_t live_stride, const float* reference, const float* gradient,
                std::ptrdiff_t reference_stride, Moments* sums) {
  HalfMoments left, right;
  left.add(live, live_stride, reference, gradient, reference_stride);
  right.add(live + kLanes, live_stride, reference + kLanes, gradient + kLanes, reference_stride);
  const Lanes column{0, 1, 2, 3, 4, 5, 6, 7};
  sums->i = lane_sum(left.i + right.i);
  sums->ii = lane_sum(left.ii + right.ii);
  sums->ir = lane_sum(left.ir + right.ir);
  sums->ig = lane_sum(left.ig + right.ig);
  sums->r = lane_sum(left.r + right.r);
  sums->g = lane_sum(left.g + right.g);
  sums->rr = lane_sum(left.rr + right.rr);
  sums->rg = lane_sum(left.rg + right.rg);
  sums->gg = lane_sum(left.gg + right.gg);
  sums->gg_x = lane_sum(left.gg * column + right.gg * (column + static_cast<float>(kLanes)));
  sums->gg_y = lane_sum(left.gg_y + right.gg_y);
}

class Refiner {
 public:
  Refiner(const SensorModel& sensor, const Image<float>& paired, const Reference& reference)
      : paired_(paired),
        reference_(reference),
        first_row_(sensor.ir_first_row() / 2 - kRows / 2),
        least_energy_(static_cast<float>(sensor.matcher.contrast_min * sensor.matcher.contrast_min) * kCount) {}

  std::optional<Estimate> refine(int x, int y, float coarse) const {
    // The first step is exact for dots that all moved alike; a second one from nearer by takes in those that did not.
    constexpr float kNearEnough = 0.75f / kPhases;  // [infrared px]
    float moved = 0.0f;
    std::optional<Estimate> estimate = step(x, y, coarse, moved);
    if (estimate && std::fabs(moved) > kNearEnough) estimate = step(x, y, estimate->disparity, moved);
    return estimate;
  }

 private:
  std::optional<Estimate> step(int x, int y, float from, float& moved) const {
    const int first_column = std::clamp(2 * x + 1 - kColumns / 2, 0, paired_.width() - kColumns);
    const int first_row = std::clamp(first_row_ + y, 0, paired_.height() - kRows);
    const ReferenceShift shift = reference_shift(from);
    const int column = first_column + 2 * reference_.margin_px + shift.whole;
    const Image<float>&shifted = reference_.shifted[shift.phase], &gradient = reference_.gradient[shift.phase];
    if (column < 0 || column + kColumns > shifted.width()) return std::nullopt;
    Moments sums;
    sum_window(paired_.row(first_row) + first_column, paired_.width(), shifted.row(first_row) + column,
               gradient.row(first_row) + column, shifted.width(), &sums);
    const float ii = sums.ii - sums.i * sums.i / kCount;
    if (ii < least_energy_) return std::nullopt;
    const float a = sums.ir - sums.i * sums.r / kCount, b = sums.ig - sums.i * sums.g / kCount;
    const float rr = sums.rr - sums.r * sums.r / kCount;
    const float rg = sums.rg - sums.r * sums.g / kCount;
    const float gg = sums.gg - sums.g * sums.g / kCount;
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
    estimate.bias = (sums.i - estimate.gain * (sums.r + t * sums.g)) / kCount;
    estimate.centre_x =
        0.5f * (static_cast<float>(first_column) + sums.gg_x / sums.gg + 0.5f) - (static_cast<float>(x) + 0.5f);
    estimate.centre_y =
        static_cast<float>(first_row - first_row_ - y) + sums.gg_y / sums.gg - static_cast<float>(kRows / 2);
    return estimate;
  }

  const Image<float>& paired_;
  const Reference& reference_;
  int first_row_;  ///< of the window of depth row 0 [row pairs]
  float least_energy_;
};

/// Disparities along one axis through a pixel, NaN outside the image and where nothing matched.
class Profile {
 public:
  Profile(const Image<Estimate>& estimates, int x, int y, int dx, int dy)
      : estimates_(estimates), x_(x), y_(y), dx_(dx), dy_(dy) {}

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

Image<Estimate> refine(const SensorModel& sensor, const Image<float>& paired, const Reference& reference,
                       const Image<float>& coarse) {
  Image<Estimate> estimates(sensor.width, sensor.height);
  const Refiner refiner(sensor, paired, reference);
  // A window needs three quarters of its columns inside the image.
  const int border = sensor.matcher.window_columns / 4;
  const float least_correlation = static_cast<float>(sensor.matcher.correlation_min);
  parallel_ranges(sensor.height, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = border; x < sensor.width - border; ++x) {
        if (std::isnan(coarse(x, y))) continue;
        const std::optional<Estimate> found = refiner.refine(x, y, coarse(x, y));
        if (found && found->correlation >= least_correlation) estimates(x, y) = *found;
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
