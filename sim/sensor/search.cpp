#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/parallel.h"
#include "core/simd.h"
#include "sim/sensor/match.h"

namespace fathom {
namespace {

using Row = std::vector<std::int16_t>;

/// column_sums += live · reference, element by element.
FATHOM_SIMD_CLONES
void add_products(const std::int16_t* __restrict live, const std::int16_t* __restrict reference,
                  std::int16_t* __restrict column_sums, int count) {
  for (int x = 0; x < count; ++x) column_sums[x] = static_cast<std::int16_t>(column_sums[x] + live[x] * reference[x]);
}

/// A row enters the window and another leaves it.
FATHOM_SIMD_CLONES
void exchange_products(const std::int16_t* __restrict live_in, const std::int16_t* __restrict reference_in,
                       const std::int16_t* __restrict live_out, const std::int16_t* __restrict reference_out,
                       std::int16_t* __restrict column_sums, int count) {
  for (int x = 0; x < count; ++x)
    column_sums[x] =
        static_cast<std::int16_t>(column_sums[x] + live_in[x] * reference_in[x] - live_out[x] * reference_out[x]);
}

/// score[x] = sum of `width` column sums from x on; keeps the best score and its disparity's index.
template <int kWidth>
inline __attribute__((always_inline)) void score_columns(const std::int16_t* __restrict column_sums, int width,
                                                         std::int16_t index, std::int16_t* __restrict score,
                                                         std::int16_t* __restrict best,
                                                         std::int16_t* __restrict best_index, int count) {
  for (int x = 0; x < count; ++x) {
    std::int16_t sum = column_sums[x];
    for (int i = 1; i < (kWidth > 0 ? kWidth : width); ++i) sum = static_cast<std::int16_t>(sum + column_sums[x + i]);
    score[x] = sum;
    best_index[x] = sum > best[x] ? index : best_index[x];
    best[x] = sum > best[x] ? sum : best[x];
  }
}

FATHOM_SIMD_CLONES
void score_row(const std::int16_t* column_sums, int width, std::int16_t index, std::int16_t* score, std::int16_t* best,
               std::int16_t* best_index, int count) {
  if (width == 9)  // the device's window: the inner loop unrolls
    score_columns<9>(column_sums, width, index, score, best, best_index, count);
  else
    score_columns<0>(column_sums, width, index, score, best, best_index, count);
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

/// Live image with `half` columns of zeros on each side, so that windows may be cut at the image's edge.
Image<std::int16_t> padded(const Image<std::int16_t>& image, int half) {
  Image<std::int16_t> result(image.width() + 2 * half, image.height());
  for (int y = 0; y < image.height(); ++y) std::copy_n(image.row(y), image.width(), result.row(y) + half);
  return result;
}

/// Searches the rows of one band; its scratch is a few hundred kilobytes and stays in the second-level cache.
class BandSearch {
 public:
  BandSearch(const SensorModel& sensor, const Image<std::int16_t>& live, const Reference& reference)
      : sensor_(sensor),
        matcher_(sensor.matcher),
        live_(live),
        reference_(reference),
        half_(matcher_.window_columns / 2),
        count_(live.width()),
        range_(matcher_.disparity_max_px - matcher_.disparity_min_px + 1),
        sums_(range_, Row(count_)),
        scores_(range_, Row(count_)),
        zeros_(count_),
        best_(count_),
        best_index_(count_) {}

  /// Searches `disparity`'s rows begin … end − 1, which are every kSearchStep-th of the depth image.
  void run(int begin, int end, Image<float>& disparity) {
    const int half_rows = matcher_.window_rows / 2;
    int centre = sensor_.ir_first_row() / 2 + begin * kSearchStep;
    for (Row& row : sums_) std::fill(row.begin(), row.end(), std::int16_t{0});
    for (int j = -half_rows; j <= half_rows; ++j) add_row(centre + j);
    for (int y = begin; y < end; ++y) {
      score_rows();
      for (int x = 0; x < disparity.width(); ++x) disparity(x, y) = peak(x);
      if (y + 1 == end) break;
      for (int step = 0; step < kSearchStep; ++step, ++centre)
        exchange_rows(centre + half_rows + 1, centre - half_rows);
    }
  }

 private:
  bool inside(int row) const { return row >= 0 && row < live_.height(); }
  const std::int16_t* reference_row(int row, int index) const {
    // Live column x (with padding) meets reference column x − half − disparity + margin.
    return reference_.search.row(row) + reference_.margin_px - half_ - (matcher_.disparity_min_px + index);
  }

  void add_row(int row) {
    if (!inside(row)) return;
    for (int i = 0; i < range_; ++i) add_products(live_.row(row), reference_row(row, i), sums_[i].data(), count_);
  }

  void exchange_rows(int entering, int leaving) {
    const bool in = inside(entering), out = inside(leaving);
    for (int i = 0; i < range_; ++i)
      exchange_products(in ? live_.row(entering) : zeros_.data(), in ? reference_row(entering, i) : zeros_.data(),
                        out ? live_.row(leaving) : zeros_.data(), out ? reference_row(leaving, i) : zeros_.data(),
                        sums_[i].data(), count_);
  }

  void score_rows() {
    std::fill(best_.begin(), best_.end(), std::numeric_limits<std::int16_t>::min());
    std::fill(best_index_.begin(), best_index_.end(), std::int16_t{0});
    for (int i = 0; i < range_; ++i)
      score_row(sums_[i].data(), matcher_.window_columns, static_cast<std::int16_t>(i), scores_[i].data(), best_.data(),
                best_index_.data(), count_ - 2 * half_);
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
  const Image<std::int16_t>& live_;
  const Reference& reference_;
  int half_, count_, range_;
  std::vector<Row> sums_;    ///< by disparity: products summed over the window's rows
  std::vector<Row> scores_;  ///< by disparity: summed over the whole window
  Row zeros_, best_, best_index_;
  ScoreLogarithm logarithm_;
};

}  // namespace

Image<float> search(const SensorModel& sensor, const Image<float>& paired, const Reference& reference) {
  const Image<std::int16_t> live =
      padded(locally_normalised(columns_in_pairs(paired), sensor.matcher), sensor.matcher.window_columns / 2);
  Image<float> disparity(sensor.width, (sensor.height + kSearchStep - 1) / kSearchStep);
  constexpr int kBandRows = 30;
  const int bands = (disparity.height() + kBandRows - 1) / kBandRows;
  parallel_ranges(bands, [&](int begin, int end) {
    for (int band = begin; band < end; ++band) {
      BandSearch search(sensor, live, reference);
      search.run(band * kBandRows, std::min((band + 1) * kBandRows, disparity.height()), disparity);
    }
  });
  return disparity;
}

}  // namespace fathom
