#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/parallel.h"
#include "core/simd.h"
#include "sim/sensor/local_contrast.h"
#include "sim/sensor/match.h"

namespace fathom {
namespace {

using Row = std::vector<std::int16_t>;

/// A row of the live image and the row of the reference that it meets at one disparity, by column parity.
struct MeetingRows {
  const std::int16_t *even, *odd;
  const std::int16_t *reference_even, *reference_odd;
};

/// Sums over the rows of a window, of products of live and reference, at one disparity.
struct ColumnSums {
  Row even, odd;  ///< by column parity
  explicit ColumnSums(int pairs) : even(pairs), odd(pairs) {}
};

FATHOM_SIMD_CLONES
void add_products(const MeetingRows& rows, std::int16_t* __restrict even, std::int16_t* __restrict odd, int pairs) {
#pragma GCC ivdep
  for (int x = 0; x < pairs; ++x) {
    even[x] = static_cast<std::int16_t>(even[x] + rows.even[x] * rows.reference_even[x]);
    odd[x] = static_cast<std::int16_t>(odd[x] + rows.odd[x] * rows.reference_odd[x]);
  }
}

using Exchange = std::array<MeetingRows, kSearchStep>;

/// Rows enter the window and as many leave it; `pairs` becomes the sum of each even column and the odd one after it.
FATHOM_SIMD_CLONES
void exchange_products(const Exchange& in, const Exchange& out, std::int16_t* __restrict even,
                       std::int16_t* __restrict odd, std::int16_t* __restrict both, int pairs) {
#pragma GCC ivdep
  for (int x = 0; x < pairs; ++x) {
    int left = even[x], right = odd[x];
    for (int j = 0; j < kSearchStep; ++j) {
      left += in[j].even[x] * in[j].reference_even[x] - out[j].even[x] * out[j].reference_even[x];
      right += in[j].odd[x] * in[j].reference_odd[x] - out[j].odd[x] * out[j].reference_odd[x];
    }
    even[x] = static_cast<std::int16_t>(left);
    odd[x] = static_cast<std::int16_t>(right);
    both[x] = static_cast<std::int16_t>(left + right);
  }
}

/// score[x] = single[x] + the sum of `count` pairs from x on; keeps the best score and its disparity's index.
template <int kPairs>
inline __attribute__((always_inline)) void score_columns(const std::int16_t* __restrict pairs,
                                                         const std::int16_t* __restrict single, int count,
                                                         std::int16_t index, std::int16_t* __restrict score,
                                                         std::int16_t* __restrict best,
                                                         std::int16_t* __restrict best_index, int width) {
  for (int x = 0; x < width; ++x) {
    std::int16_t sum = single[x];
    for (int i = 0; i < (kPairs > 0 ? kPairs : count); ++i) sum = static_cast<std::int16_t>(sum + pairs[x + i]);
    score[x] = sum;
    best_index[x] = sum > best[x] ? index : best_index[x];
    best[x] = sum > best[x] ? sum : best[x];
  }
}

FATHOM_SIMD_CLONES
void score_row(const std::int16_t* pairs, const std::int16_t* single, int count, std::int16_t index,
               std::int16_t* score, std::int16_t* best, std::int16_t* best_index, int width) {
  if (count == 4)  // the device's window: the inner loop unrolls
    score_columns<4>(pairs, single, count, index, score, best, best_index, width);
  else
    score_columns<0>(pairs, single, count, index, score, best, best_index, width);
}

/// Logarithms of scores, a table fine enough for the peak's interpolation.
class ScoreLogarithm {
 public:
  ScoreLogarithm() {
    for (int i = 0; i < kSize; ++i) table_[i] = std::log(static_cast<float>(i) + 0.5f);
  }
  float operator()(std::int16_t score) const { return table_[std::max<int>(score, 0) >> kShift]; }

 private:
  static constexpr int kShift = 2, kSize = 32768 >> kShift;
  std::array<float, kSize> table_;
};

/// Searches the rows of one band; its scratch is a few hundred kilobytes and stays in the second-level cache.
class BandSearch {
 public:
  BandSearch(const SensorModel& sensor, const SplitColumns<std::int16_t>& live, const Reference& reference,
             const ScoreLogarithm& logarithm)
      : sensor_(sensor),
        matcher_(sensor.matcher),
        live_(live),
        reference_(reference),
        half_(matcher_.window_columns / 2),
        pairs_(live.even.width()),
        range_(matcher_.disparity_max_px - matcher_.disparity_min_px + 1),
        sums_(range_, ColumnSums(pairs_)),
        scores_(range_, Row(pairs_)),
        zeros_(pairs_),
        both_(pairs_),
        best_(pairs_),
        best_index_(pairs_),
        logarithm_(logarithm) {}

  /// Searches `disparity`'s rows begin … end − 1, which are every kSearchStep-th of the depth image.
  void run(int begin, int end, Image<float>& disparity) {
    const int half_rows = matcher_.window_rows / 2;
    int centre = sensor_.ir_first_row() / 2 + (begin - 1) * kSearchStep + kSearchStep / 2;
    for (ColumnSums& sums : sums_) {
      std::fill(sums.even.begin(), sums.even.end(), std::int16_t{0});
      std::fill(sums.odd.begin(), sums.odd.end(), std::int16_t{0});
    }
    for (int j = -half_rows; j <= half_rows; ++j)
      for (int i = 0; i < range_; ++i)
        add_products(meeting(centre + j, i), sums_[i].even.data(), sums_[i].odd.data(), pairs_);
    for (int y = begin; y < end; ++y, centre += kSearchStep) {
      score_rows(centre + half_rows + 1, centre - half_rows, disparity.width());
      for (int x = 0; x < disparity.width(); ++x) disparity(x, y) = peak(x);
    }
  }

 private:
  /// A row at a disparity's index; zeros outside the image.
  MeetingRows meeting(int row, int index) const {
    if (row < 0 || row >= live_.even.height()) return {zeros_.data(), zeros_.data(), zeros_.data(), zeros_.data()};
    // Live column 2 x (framed) meets reference column 2 x − frame − disparity + margin.
    const int shift = reference_.margin_px - (half_ + 1) / 2 * 2 - (matcher_.disparity_min_px + index);
    const std::int16_t *even = reference_.search.even.row(row), *odd = reference_.search.odd.row(row);
    const bool crossed = shift % 2 != 0;  // the margin is wider than the search: shift > 0
    return {live_.even.row(row), live_.odd.row(row), (crossed ? odd : even) + shift / 2,
            (crossed ? even + 1 : odd) + shift / 2};
  }

  /// Moves the windows down by kSearchStep rows, to those that end before `entering` + kSearchStep, and scores them.
  void score_rows(int entering, int leaving, int width) {
    std::fill(best_.begin(), best_.end(), std::numeric_limits<std::int16_t>::min());
    std::fill(best_index_.begin(), best_index_.end(), std::int16_t{0});
    const bool even_half = half_ % 2 == 0;  // the window is `half_` pairs and one more column, right or left of them
    for (int i = 0; i < range_; ++i) {
      Exchange in, out;
      for (int j = 0; j < kSearchStep; ++j) in[j] = meeting(entering + j, i), out[j] = meeting(leaving + j, i);
      ColumnSums& sums = sums_[i];
      exchange_products(in, out, sums.even.data(), sums.odd.data(), both_.data(), pairs_);
      score_row(even_half ? both_.data() : both_.data() + 1, even_half ? sums.even.data() + half_ : sums.odd.data(),
                half_, static_cast<std::int16_t>(i), scores_[i].data(), best_.data(), best_index_.data(), width);
    }
  }

  /// The dots' correlation falls off like a Gaussian, so a parabola through the logarithms of three scores meets its
  /// peak.
  float peak(int x) const {
    const int i = best_index_[x];
    if (i == 0 || i == range_ - 1 || best_[x] <= 0) return std::numeric_limits<float>::quiet_NaN();
    const float left = logarithm_(scores_[i - 1][x]), middle = logarithm_(best_[x]),
                right = logarithm_(scores_[i + 1][x]);
    const float curvature = left - 2.0f * middle + right;
    const float offset = curvature < 0.0f ? 0.5f * (left - right) / curvature : 0.0f;
    return static_cast<float>(matcher_.disparity_min_px + i) + offset;
  }

  const SensorModel& sensor_;
  const MatcherModel& matcher_;
  const SplitColumns<std::int16_t>& live_;
  const Reference& reference_;
  int half_, pairs_, range_;
  std::vector<ColumnSums> sums_;  ///< by disparity
  std::vector<Row> scores_;       ///< by disparity: summed over the whole window
  Row zeros_, both_, best_, best_index_;
  const ScoreLogarithm& logarithm_;
};

}  // namespace

Image<float> search(const SensorModel& sensor, const SplitColumns<float>& paired, const Reference& reference) {
  const int frame = (sensor.matcher.window_columns / 2 + 1) / 2 * 2;  // even, and no less than half a window
  const SplitColumns<std::int16_t> live =
      locally_normalised(mean_of_columns(paired, sensor.width), sensor.matcher, frame);
  Image<float> disparity((sensor.width + 1) / 2, (sensor.height + kSearchStep - 1) / kSearchStep);
  const ScoreLogarithm logarithm;
  constexpr int kBandRows = 16;
  const int bands = (disparity.height() + kBandRows - 1) / kBandRows;
  parallel_items(bands, [&](int band) {
    BandSearch search(sensor, live, reference, logarithm);
    search.run(band * kBandRows, std::min((band + 1) * kBandRows, disparity.height()), disparity);
  });
  return disparity;
}

}  // namespace fathom
