#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "core/parallel.h"
#include "core/simd.h"
#include "sim/sensor/match.h"

namespace fathom {
namespace {

constexpr float kCount = kRefineColumns * kRefineRows;

/// Half a row of the window: one register where there are wide ones; elsewhere the compiler splits it.
constexpr int kLanes = kRefineColumns / 2;
using Lanes = float __attribute__((vector_size(kLanes * sizeof(float))));

inline __attribute__((always_inline)) void load(const float* from, Lanes& lanes) {
  std::memcpy(&lanes, from, sizeof(lanes));
}

/// Sums of the lanes of two registers at once, added pairwise and always in the same order, so that every instruction
/// set rounds alike.
inline __attribute__((always_inline)) void sum_lanes(const Lanes& a, const Lanes& b, float& sum_a, float& sum_b) {
  using Index = int __attribute__((vector_size(sizeof(Lanes))));
  const Lanes fours = __builtin_shuffle(a, b, Index{0, 1, 2, 3, 8, 9, 10, 11}) +
                      __builtin_shuffle(a, b, Index{4, 5, 6, 7, 12, 13, 14, 15});
  const Lanes twos = fours + __builtin_shuffle(fours, Index{2, 3, 2, 3, 6, 7, 6, 7});
  const Lanes ones = twos + __builtin_shuffle(twos, Index{1, 1, 1, 1, 5, 5, 5, 5});
  sum_a = ones[0], sum_b = ones[4];
}

/// A place for every pixel of a row that is to be refined, as arrays, so that the compiler makes vectors of the
/// arithmetic.
struct RowScratch {
  std::vector<int> x;                ///< depth column
  std::vector<int> searched;         ///< whether the search found a disparity to start from
  std::vector<float> from, rest;     ///< disparity to start from [px] and its part below a phase [infrared px]
  std::vector<int> live, reference;  ///< first column of the window in the live image and in the reference
  std::vector<int> phase;
  std::vector<float> i, ii, ir, ig;     ///< sums over the window of the live image i with itself, r and g
  std::vector<float> r, g, rr, rg, gg;  ///< the reference's, see WindowMoments
  std::vector<float> centre_x,
      centre_y;  ///< gg_x, gg_y; solve() makes them g²'s centroid from the window's first pixel
  std::vector<float> moved, correlation, gain, bias;

  explicit RowScratch(int width) {
    for (auto* numbers : {&x, &searched, &live, &reference, &phase}) numbers->resize(width);
    for (auto* values : {&from, &rest, &i, &ii, &ir, &ig, &r, &g, &rr, &rg, &gg, &centre_x, &centre_y, &moved,
                         &correlation, &gain, &bias})
      values->resize(width);
  }
};

/// The window of scratch place k in the live image, and in the reference where its disparity puts it. The reference's
/// margin is wide enough for every disparity of the search.
inline __attribute__((always_inline)) void place_window(RowScratch& s, int k, int live_width, int margin_px) {
  const ReferenceShift shift = reference_shift(s.from[k]);
  const int centred = 2 * s.x[k] + 1 - kRefineColumns / 2;
  const int last = live_width - kRefineColumns;
  const int live = centred < 0 ? 0 : centred > last ? last : centred;
  s.rest[k] = shift.rest_ir_px;
  s.live[k] = live;
  s.reference[k] = live + 2 * margin_px + shift.whole;
  s.phase[k] = shift.phase;
}

/// Places for `count` pixels from `first` on; without a coarse disparity they stand in the reference plane, and are not
/// kept.
FATHOM_SIMD_CLONES
void place_windows(const float* coarse, int first, int live_width, int margin_px, RowScratch& s, int count) {
#pragma GCC ivdep
  for (int k = 0; k < count; ++k) {
    const float from = coarse[first + k];
    s.x[k] = first + k;
    s.searched[k] = from == from;
    s.from[k] = from == from ? from : 0.0f;
    place_window(s, k, live_width, margin_px);
  }
}

/// Σ live · reference and Σ live · gradient over the windows of one row's pixels. `stride`s are the images' widths;
/// `reference` and `gradient` hold the first rows of the windows by phase.
FATHOM_SIMD_CLONES
void cross_moments(const float* live_row, std::ptrdiff_t live_stride,
                   const std::array<const float*, kPhases>& reference,
                   const std::array<const float*, kPhases>& gradient, std::ptrdiff_t reference_stride, RowScratch& s,
                   int count) {
  for (int k = 0; k < count; ++k) {
    const float* live = live_row + s.live[k];
    const float* r = reference[s.phase[k]] + s.reference[k];
    const float* g = gradient[s.phase[k]] + s.reference[k];
    Lanes r_left{}, r_right{}, g_left{}, g_right{};
#pragma GCC unroll 1
    for (int row = 0; row < kRefineRows; ++row) {
      Lanes a, b, c;
      load(live, a), load(r, b), load(g, c);
      r_left += a * b, g_left += a * c;
      load(live + kLanes, a), load(r + kLanes, b), load(g + kLanes, c);
      r_right += a * b, g_right += a * c;
      live += live_stride, r += reference_stride, g += reference_stride;
    }
    sum_lanes(r_left + r_right, g_left + g_right, s.ir[k], s.ig[k]);
  }
}

/// The shift t that maximises the correlation of i with r + t g, (a + t b) / √(ii (rr + 2 t rg + t² gg)), with the
/// correlation, gain and bias there. A window without contrast or maximum gets the correlation −1.
FATHOM_SIMD_CLONES
void solve(RowScratch& s, float least_energy, int count) {
  constexpr float kFarthest = 1.5f;  // [infrared px]; beyond, the derivative says nothing
  constexpr float kTiny = 1e-12f;
  float *moved = s.moved.data(), *correlation = s.correlation.data(), *gain = s.gain.data(), *bias = s.bias.data();
  float *centre_x = s.centre_x.data(), *centre_y = s.centre_y.data();
  const float *i = s.i.data(), *r = s.r.data(), *g = s.g.data();
  const float *sum_ii = s.ii.data(), *sum_ir = s.ir.data(), *sum_ig = s.ig.data();
  const float *sum_rr = s.rr.data(), *sum_rg = s.rg.data(), *sum_gg = s.gg.data();
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
    centre_x[k] *= per_energy;
    centre_y[k] *= per_energy;
  }
}

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
    for (int i = 0; i < kRefineColumns; ++i) sum += column[x + i];
    sums[x] = sum;
  }
}

/// Sums and sums of squares of a row of live windows, by first column.
struct LiveSums {
  std::vector<float> column, column_square, value, square;

  explicit LiveSums(int width) : column(width), column_square(width), value(width), square(width) {}

  void update(const Image<float>& paired, int first_row) {
    const int width = paired.width();
    std::fill(column.begin(), column.end(), 0.0f);
    std::fill(column_square.begin(), column_square.end(), 0.0f);
    for (int j = 0; j < kRefineRows; ++j)
      add_columns(paired.row(first_row + j), column.data(), column_square.data(), width);
    slide(column.data(), value.data(), width - kRefineColumns + 1);
    slide(column_square.data(), square.data(), width - kRefineColumns + 1);
  }
};

/// Refines one depth row after the other.
class RowRefiner {
 public:
  RowRefiner(const SensorModel& sensor, const Image<float>& paired, const Reference& reference)
      : sensor_(sensor), paired_(paired), reference_(reference), scratch_(sensor.width), live_sums_(paired.width()) {}

  void refine(int y, const float* coarse, Estimates& estimates) {
    // A window needs three quarters of its columns inside the image.
    const int border = sensor_.matcher.window_columns / 4;
    live_sums_.update(paired_, refine_first_row(sensor_, y));
    count_ = sensor_.width - 2 * border;
    place_windows(coarse, border, paired_.width(), reference_.margin_px, scratch_, count_);
    step(y);
    keep(y, estimates);
    // The step is exact for dots that all moved alike; a second one from nearer by takes in those that did not.
    constexpr float kNearEnough = 0.75f / kPhases;  // [infrared px]
    const int first_count = count_;
    count_ = 0;
    for (int k = 0; k < first_count; ++k)
      if (std::fabs(scratch_.moved[k]) > kNearEnough && estimates.valid(scratch_.x[k], y)) {
        scratch_.x[count_] = scratch_.x[k];
        scratch_.searched[count_] = 1;
        scratch_.from[count_++] = estimates.disparity(scratch_.x[k], y);
      }
    for (int k = 0; k < count_; ++k) place_window(scratch_, k, paired_.width(), reference_.margin_px);
    step(y);
    keep(y, estimates);
  }

 private:
  void step(int y) {
    RowScratch& s = scratch_;
    for (int k = 0; k < count_; ++k) {
      constexpr int kAhead = 16;  // the table is larger than the caches
      if (k + kAhead < count_)
        __builtin_prefetch(&reference_.moments_at(y, s.phase[k + kAhead], s.reference[k + kAhead]));
      const WindowMoments& memory = reference_.moments_at(y, s.phase[k], s.reference[k]);
      s.i[k] = live_sums_.value[s.live[k]], s.ii[k] = live_sums_.square[s.live[k]];
      s.r[k] = memory.r, s.g[k] = memory.g, s.rr[k] = memory.rr, s.rg[k] = memory.rg, s.gg[k] = memory.gg;
      s.centre_x[k] = memory.gg_x, s.centre_y[k] = memory.gg_y;
    }
    const int first_row = refine_first_row(sensor_, y);
    std::array<const float*, kPhases> shifted, gradient;
    for (int phase = 0; phase < kPhases; ++phase) {
      shifted[phase] = reference_.shifted[phase].row(first_row);
      gradient[phase] = reference_.gradient[phase].row(first_row);
    }
    cross_moments(paired_.row(first_row), paired_.width(), shifted, gradient, reference_.shifted[0].width(), s, count_);
    const float contrast = static_cast<float>(sensor_.matcher.contrast_min);
    solve(s, contrast * contrast * kCount, count_);
  }

  void keep(int y, Estimates& estimates) const {
    const RowScratch& s = scratch_;
    const float least_correlation = static_cast<float>(sensor_.matcher.correlation_min);
    const float row_offset = static_cast<float>(refine_first_row(sensor_, y) - sensor_.ir_first_row() / 2 - y);
    float *disparity = estimates.disparity.row(y), *correlation = estimates.correlation.row(y);
    float *gain = estimates.gain.row(y), *bias = estimates.bias.row(y);
    float *centre_x = estimates.centre_x.row(y), *centre_y = estimates.centre_y.row(y);
    for (int k = 0; k < count_; ++k) {
      const int x = s.x[k];
      const bool found = s.searched[k] && s.correlation[k] >= least_correlation;
      disparity[x] = found ? s.from[k] + 0.5f * (s.rest[k] - s.moved[k]) : std::numeric_limits<float>::quiet_NaN();
      correlation[x] = found ? s.correlation[k] : 0.0f;
      gain[x] = s.gain[k], bias[x] = s.bias[k];
      centre_x[x] = 0.5f * (static_cast<float>(s.live[k]) + s.centre_x[k] + 0.5f) - (static_cast<float>(x) + 0.5f);
      centre_y[x] = row_offset + s.centre_y[k];
    }
  }

  const SensorModel& sensor_;
  const Image<float>& paired_;
  const Reference& reference_;
  RowScratch scratch_;
  LiveSums live_sums_;
  int count_ = 0;
};

}  // namespace

Estimates refine(const SensorModel& sensor, const Image<float>& paired, const Reference& reference,
                 const Image<float>& coarse) {
  Estimates estimates(sensor.width, sensor.height);
  parallel_ranges(sensor.height, [&](int begin, int end) {
    RowRefiner refiner(sensor, paired, reference);
    for (int y = begin; y < end; ++y) refiner.refine(y, coarse.row(y), estimates);
  });
  return estimates;
}

}  // namespace fathom
