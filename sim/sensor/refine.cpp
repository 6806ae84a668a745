#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/parallel.h"
#include "core/simd.h"
#include "sim/sensor/match.h"
#include "sim/sensor/window_sums.h"

namespace fathom {
namespace {

constexpr float kCount = kRefineColumns * kRefineRows;

/// What is known of every pixel of a row that is refined, as arrays, so that the compiler makes vectors of the
/// arithmetic.
struct RowScratch {
  std::vector<int> live;           ///< first column of the window in the live image
  std::vector<int> whole, phase;   ///< the shift at which the reference is compared
  std::vector<std::uint8_t> open;  ///< whether the window is still to be summed
  std::vector<float> from, rest;   ///< disparity to start from [px] and its part below the shift [infrared px]
  Image<float> sums;               ///< a row for each WindowSum
  std::vector<float> moved, correlation, gain, bias, centre_x, centre_y;

  explicit RowScratch(int width) : live(width), whole(width), phase(width), open(width), sums(width, kWindowSums) {
    for (auto* values : {&from, &rest, &moved, &correlation, &gain, &bias, &centre_x, &centre_y}) values->resize(width);
  }
  int width() const { return static_cast<int>(live.size()); }
};

/// Sets the shift at which each open window is compared with the reference. It keeps that of the one on its left as
/// long as its own is near enough: windows of the same shift share their sums.
void place_windows(RowScratch& s) {
  constexpr float kKept = 0.7f / kPhases;  // [infrared px]
  ReferenceShift held{};
  float held_ir_px = std::numeric_limits<float>::quiet_NaN();
  for (int k = 0; k < s.width(); ++k) {
    if (!s.open[k]) continue;
    const float shift_ir_px = -2.0f * s.from[k];
    if (!(std::fabs(shift_ir_px - held_ir_px) < kKept)) {
      held = reference_shift(s.from[k]);
      held_ir_px = shift_ir_px - held.rest_ir_px;
    }
    s.whole[k] = held.whole, s.phase[k] = held.phase;
    s.rest[k] = shift_ir_px - held_ir_px;
  }
}

/// The shift t that maximises the correlation of i with r + t g, (a + t b) / √(ii (rr + 2 t rg + t² gg)), with the
/// correlation, gain and bias there. A window without contrast or maximum gets the correlation −1.
FATHOM_SIMD_CLONES
void solve(RowScratch& s, float least_energy) {
  constexpr float kFarthest = 1.5f;  // [infrared px]; beyond, the derivative says nothing
  constexpr float kTiny = 1e-12f;
  float *moved = s.moved.data(), *correlation = s.correlation.data(), *gain = s.gain.data(), *bias = s.bias.data();
  float *centre_x = s.centre_x.data(), *centre_y = s.centre_y.data();
  const float *i = s.sums.row(kI), *r = s.sums.row(kR), *g = s.sums.row(kG);
  const float *sum_ii = s.sums.row(kII), *sum_ir = s.sums.row(kIR), *sum_ig = s.sums.row(kIG);
  const float *sum_rr = s.sums.row(kRR), *sum_rg = s.sums.row(kRG), *sum_gg = s.sums.row(kGG);
  const float *gg_x = s.sums.row(kGGx), *gg_y = s.sums.row(kGGy);
  const int count = s.width();
#pragma GCC ivdep
  for (int k = 0; k < count; ++k) {
    const float mean = i[k] / kCount;
    const float ii = sum_ii[k] - i[k] * mean;
    const float a = sum_ir[k] - mean * r[k], b = sum_ig[k] - mean * g[k];
    const float rr = sum_rr[k] - r[k] * r[k] / kCount;
    const float rg = sum_rg[k] - r[k] * g[k] / kCount;
    const float gg = sum_gg[k] - g[k] * g[k] / kCount;
    const float denominator = a * gg - b * rg;
    const float t = (b * rr - a * rg) / (denominator > kTiny ? denominator : kTiny);
    const float energy = rr + 2.0f * t * rg + t * t * gg;
    const float both = a + t * b;
    const float squared = ii * energy;
    // No short-circuit: branches would keep the compiler from making vectors of this.
    const bool good =
        (denominator > kTiny) & (ii > least_energy) & (t < kFarthest) & (t > -kFarthest) & (energy > kTiny);
    const float own_gain = both / (energy > kTiny ? energy : kTiny);
    const float own_correlation = both / std::sqrt(squared > kTiny ? squared : kTiny);
    moved[k] = t;
    correlation[k] = good ? own_correlation : -1.0f;
    gain[k] = own_gain;
    bias[k] = mean - own_gain * (r[k] + t * g[k]) / kCount;
    const float per_energy = 1.0f / (sum_gg[k] + 1e-9f);
    centre_x[k] = gg_x[k] * per_energy;
    centre_y[k] = gg_y[k] * per_energy;
  }
}

/// Starts the windows of a row from the search's disparities, or from the row above's where it saw the same surface:
/// those are nearer the truth. Windows without any stand where their left neighbour does.
FATHOM_SIMD_CLONES
void choose_starts(const float* coarse, const float* above, float* from, int count) {
  constexpr float kSameSurface = 0.3f;  // [px]
#pragma GCC ivdep
  for (int k = 0; k < count; ++k) from[k] = std::fabs(coarse[k] - above[k]) < kSameSurface ? above[k] : coarse[k];
}

/// Opens those windows again that moved so far that a second step from nearer by is worth its time: one step is exact
/// for dots that all moved alike. Returns whether there are any.
bool reopen(RowScratch& s, float least_correlation) {
  constexpr float kNearEnough = 1.0f / kPhases;  // [infrared px]
  bool any = false;
  for (int k = 0; k < s.width(); ++k) {
    s.open[k] = std::fabs(s.moved[k]) > kNearEnough && s.correlation[k] >= least_correlation;
    if (!s.open[k]) continue;
    s.from[k] += 0.5f * (s.rest[k] - s.moved[k]);
    any = true;
  }
  return any;
}

/// A row of the estimates, as pointers to its first refined pixel.
struct EstimatesRow {
  float *disparity, *correlation, *gain, *bias, *centre_x, *centre_y;
};

FATHOM_SIMD_CLONES
void keep_row(const RowScratch& s, const float* coarse, float least_correlation, int first_x, float row_offset,
              const EstimatesRow& row) {
  const float *from = s.from.data(), *rest = s.rest.data(), *moved = s.moved.data(),
              *correlation = s.correlation.data(), *gain = s.gain.data(), *bias = s.bias.data(),
              *centre_x = s.centre_x.data(), *centre_y = s.centre_y.data();
  const int *live = s.live.data(), count = s.width();
#pragma GCC ivdep
  for (int k = 0; k < count; ++k) {
    const bool found = (coarse[k] == coarse[k]) & (correlation[k] >= least_correlation);
    const float disparity = from[k] + 0.5f * (rest[k] - moved[k]);
    row.disparity[k] = found ? disparity : std::numeric_limits<float>::quiet_NaN();
    row.correlation[k] = found ? correlation[k] : 0.0f;
    row.gain[k] = gain[k], row.bias[k] = bias[k];
    row.centre_x[k] =
        0.5f * (static_cast<float>(live[k]) + centre_x[k] + 0.5f) - (static_cast<float>(first_x + k) + 0.5f);
    row.centre_y[k] = row_offset + centre_y[k];
  }
}

/// Refines one depth row after the other.
class RowRefiner {
 public:
  RowRefiner(const SensorModel& sensor, const Image<float>& paired, const Reference& reference)
      : sensor_(sensor),
        paired_(paired),
        reference_(reference),
        // A window needs three quarters of its columns inside the image.
        border_(sensor.matcher.window_columns / 4),
        scratch_(sensor.width - 2 * border_) {
    for (int k = 0; k < scratch_.width(); ++k)
      scratch_.live[k] = std::clamp(2 * (border_ + k) + 1 - kRefineColumns / 2, 0, paired.width() - kRefineColumns);
  }

  /// `above` holds the disparities of the row above; the search's own where there are none.
  void refine(int y, const float* coarse, const float* above, Estimates& estimates) {
    RowScratch& s = scratch_;
    const float contrast = static_cast<float>(sensor_.matcher.contrast_min);
    const float least_energy = contrast * contrast * kCount;
    const float least_correlation = static_cast<float>(sensor_.matcher.correlation_min);
    coarse += border_;
    choose_starts(coarse, above + border_, s.from.data(), s.width());
    for (int k = 0; k < s.width(); ++k)
      if (std::isnan(s.from[k])) s.from[k] = k > 0 ? s.from[k - 1] : 0.0f;
    std::fill(s.open.begin(), s.open.end(), std::uint8_t{1});
    sum_open_windows(y);
    solve(s, least_energy);
    if (reopen(s, least_correlation)) {
      sum_open_windows(y);
      solve(s, least_energy);
    }
    const int row_offset = refine_first_row(sensor_, y) - sensor_.ir_first_row() / 2 - y;
    const auto at = [&](Image<float>& image) { return image.row(y) + border_; };
    keep_row(s, coarse, least_correlation, border_, static_cast<float>(row_offset),
             {at(estimates.disparity), at(estimates.correlation), at(estimates.gain), at(estimates.bias),
              at(estimates.centre_x), at(estimates.centre_y)});
  }

 private:
  void sum_open_windows(int y) {
    RowScratch& s = scratch_;
    place_windows(s);
    for (int first = 0, end; first < s.width(); first = end) {
      end = first + 1;
      if (!s.open[first]) continue;
      while (end < s.width() && end - first < kRunWindows && s.open[end] && s.phase[end] == s.phase[first] &&
             s.whole[end] == s.whole[first] && s.live[end] == s.live[end - 1] + 2)
        ++end;
      sum_run(y, first, end);
    }
  }

  void sum_run(int y, int first, int end) {
    RowScratch& s = scratch_;
    const int row = refine_first_row(sensor_, y), live = s.live[first], phase = s.phase[first];
    const int column = live + 2 * reference_.margin_px + s.whole[first];  // the margin holds every disparity searched
    const Image<float>&shifted = reference_.shifted[phase], &gradient = reference_.gradient[phase];
    sum_windows({paired_.row(row) + live, paired_.width()}, {shifted.row(row) + column, shifted.width()},
                {gradient.row(row) + column, gradient.width()}, end - first, first, s.sums);
  }

  const SensorModel& sensor_;
  const Image<float>& paired_;
  const Reference& reference_;
  int border_;
  RowScratch scratch_;
};

}  // namespace

Estimates refine(const SensorModel& sensor, const Image<float>& paired, const Reference& reference,
                 const Image<float>& coarse) {
  Estimates estimates(sensor.width, sensor.height);
  constexpr int kBandRows = 60;  // the same bands for any number of threads
  const int bands = (sensor.height + kBandRows - 1) / kBandRows;
  parallel_ranges(bands, [&](int begin, int end) {
    RowRefiner refiner(sensor, paired, reference);
    for (int y = begin * kBandRows; y < std::min(end * kBandRows, sensor.height); ++y)
      refiner.refine(y, coarse.row(y / kSearchStep),
                     y % kBandRows > 0 ? estimates.disparity.row(y - 1) : coarse.row(y / kSearchStep), estimates);
  });
  return estimates;
}

}  // namespace fathom
