#include "sim/sensor/block_match.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "core/simd.h"
#include "sim/sensor/match.h"

namespace fathom {
namespace {

FATHOM_SIMD_CLONES
void add_row(const float* __restrict values, double* __restrict sums, double* __restrict squares, int width) {
  for (int x = 0; x < width; ++x) {
    const double value = values[x];
    sums[x] += value, squares[x] += value * value;
  }
}

/// Of the sums and squares of `columns` neighbouring columns of `count` values in all.
FATHOM_SIMD_CLONES
void sum_blocks(const double* __restrict sums, const double* __restrict squares, int columns, double count,
                float* __restrict sum, float* __restrict spread, int width) {
  for (int x = 0; x < width; ++x) {
    double of_values = 0.0, of_squares = 0.0;
    for (int column = 0; column < columns; ++column) of_values += sums[x + column], of_squares += squares[x + column];
    sum[x] = static_cast<float>(of_values);
    spread[x] = static_cast<float>(std::sqrt(std::max(of_squares - of_values * of_values / count, 0.0)));
  }
}

Blocks blocks_of(const MatcherModel& matcher, Image<float> values) {
  const int columns = matcher.window_columns, rows = matcher.window_rows;
  Blocks blocks{std::move(values), {}, {}};
  const int width = blocks.values.width(), height = blocks.values.height();
  blocks.sum = Image<float>(width, height);
  blocks.spread = Image<float>(width, height);
  parallel_ranges(std::max(height - rows + 1, 0), [&](int begin, int end) {
    std::vector<double> sums(width), squares(width);
    for (int y = begin; y < end; ++y) {
      std::fill(sums.begin(), sums.end(), 0.0);
      std::fill(squares.begin(), squares.end(), 0.0);
      for (int row = 0; row < rows; ++row) add_row(blocks.values.row(y + row), sums.data(), squares.data(), width);
      sum_blocks(sums.data(), squares.data(), columns, columns * rows, blocks.sum.row(y), blocks.spread.row(y),
                 width - columns + 1);
    }
  });
  return blocks;
}

/// Sum of products of two blocks of `columns` × `rows`.
template <int kColumns>
inline __attribute__((always_inline)) float block_product(const float* a, std::ptrdiff_t stride_a, const float* b,
                                                          std::ptrdiff_t stride_b, int columns, int rows) {
  float sum[16] = {};
  for (int row = 0; row < rows; ++row, a += stride_a, b += stride_b)
    for (int x = 0; x < (kColumns > 0 ? kColumns : columns); ++x) sum[x & 15] += a[x] * b[x];
  float total = 0.0f;
  for (const float part : sum) total += part;
  return total;
}

/// Speckle makes dots as bright as chance has it. In light the brightest outweigh a block's others; in its root less.
Image<float> compressed(const MatcherModel& matcher, Image<float> light) {
  if (matcher.compression == 0.0) return light;
  const auto dark = static_cast<float>(matcher.compression);
  parallel_rows(light.height(), [&](int y) {
    for (int x = 0; x < light.width(); ++x) light(x, y) = std::sqrt(std::max(light(x, y) + dark, 0.0f));
  });
  return light;
}

struct Candidate {
  float disparity = 0.0f;
  float correlation = -1.0f;
};

/// Writes the disparities that are believed: those of at least the least correlation, and those of somewhat less where
/// the nearest of at least that, within a block to the left and within one to the right, both have the same disparity.
/// Speckle lowers the correlation of single blocks; beside a shadow, where a block holds part of a surface, one of the
/// two is missing.
void believe(const MatcherModel& matcher, const std::vector<Candidate>& row, float* disparity) {
  constexpr float kLessAlike = 0.8f;    // of the least correlation
  constexpr float kSameSurface = 0.5f;  // [px]
  const int count = static_cast<int>(row.size()), reach = matcher.window_columns;
  const auto least = static_cast<float>(matcher.correlation_min);
  const auto shows_the_same = [&](int x, int direction) {
    for (int other = x + direction; other >= 0 && other < count && std::abs(other - x) <= reach; other += direction)
      if (row[other].correlation >= least) return std::fabs(row[other].disparity - row[x].disparity) < kSameSurface;
    return false;
  };
  for (int x = 0; x < count; ++x)
    if (row[x].correlation >= least ||
        (row[x].correlation >= kLessAlike * least && shows_the_same(x, -1) && shows_the_same(x, 1)))
      disparity[x] = row[x].disparity;
}

/// The blocks of one row of the depth image.
class RowMatcher {
 public:
  RowMatcher(const SensorModel& sensor, const Blocks& live, const BlockReference& reference, int margin_px)
      : matcher_(sensor.matcher),
        live_(live),
        reference_(reference),
        margin_px_(margin_px),
        count_(static_cast<float>(matcher_.window_columns * matcher_.window_rows)) {}

  /// Climbs from a disparity [1/8 px] to the best of its surroundings.
  FATHOM_SIMD_CLONES
  Candidate climb(int left, int top, int eighths) const {
    constexpr int kMostSteps = 2 * kPhases;
    float best = score(left, top, eighths);
    for (int direction : {1, -1})
      for (int step = 0; step < kMostSteps; ++step) {
        const float next = score(left, top, eighths + direction);
        if (next <= best) break;
        best = next, eighths += direction;
        if (step == kMostSteps - 1) return {};
      }
    return {static_cast<float>(eighths) / kPhases, best};
  }

 private:
  /// Zero-mean normalised cross-correlation of a block with the reference at a disparity.
  inline __attribute__((always_inline)) float score(int left, int top, int eighths) const {
    constexpr int kOffset = 1 << 14;  // keeps the division of a positive number
    const int shift = kOffset * kPhases - eighths;
    const int column = left + margin_px_ + shift / kPhases - kOffset;
    const Blocks& reference = reference_.phase[shift % kPhases];
    const float *a = &live_.values(left, top), *b = &reference.values(column, top);
    const float product =
        matcher_.window_columns == 9
            ? block_product<9>(a, live_.values.width(), b, reference.values.width(), 9, matcher_.window_rows)
            : block_product<0>(a, live_.values.width(), b, reference.values.width(), matcher_.window_columns,
                               matcher_.window_rows);
    return (product - live_.sum(left, top) * reference.sum(column, top) / count_) /
           (live_.spread(left, top) * reference.spread(column, top) + 1e-6f);
  }

  const MatcherModel& matcher_;
  const Blocks& live_;
  const BlockReference& reference_;
  int margin_px_;
  float count_;
};

}  // namespace

BlockReference block_reference(const MatcherModel& matcher, std::span<const Image<float>> phases) {
  constexpr int kHalf = kPhases / 2;  // of a depth pixel: one infrared pixel
  BlockReference reference;
  for (int eighth = 0; eighth < kPhases; ++eighth) {
    const bool in_right_half = eighth >= kHalf;
    const Image<float>&left = phases[eighth], &right = phases[in_right_half ? eighth - kHalf : eighth + kHalf];
    Image<float> values(left.width(), left.height());
    parallel_rows(values.height(), [&](int y) {
      for (int x = 0; x < values.width(); ++x)
        values(x, y) = 0.5f * (left(x, y) + right(std::min(x + in_right_half, right.width() - 1), y));
    });
    reference.phase.push_back(blocks_of(matcher, compressed(matcher, std::move(values))));
  }
  return reference;
}

Image<float> block_match(const SensorModel& sensor, Image<float> halved, const BlockReference& reference, int margin_px,
                         const Image<float>& coarse) {
  const MatcherModel& matcher = sensor.matcher;
  const Blocks light = blocks_of(matcher, halved);
  const Blocks live = blocks_of(matcher, compressed(matcher, std::move(halved)));
  const RowMatcher rows(sensor, live, reference, margin_px);
  const int half_columns = matcher.window_columns / 2, half_rows = matcher.window_rows / 2;
  const auto least_spread = static_cast<float>(
      matcher.contrast_min * std::sqrt(static_cast<double>(matcher.window_columns) * matcher.window_rows));
  const auto least_spread_of_sum = static_cast<float>(
      matcher.relative_contrast_min / std::sqrt(static_cast<double>(matcher.window_columns) * matcher.window_rows));
  Image<float> disparity(sensor.width, sensor.height, std::numeric_limits<float>::quiet_NaN());
  parallel_ranges(sensor.height, [&](int begin, int end) {
    std::vector<Candidate> row(sensor.width);
    for (int y = begin; y < end; ++y) {
      const int top = sensor.ir_first_row() / 2 + y - half_rows;
      if (top < 0 || top + matcher.window_rows > live.values.height()) continue;
      std::fill(row.begin(), row.end(), Candidate{});
      for (int x = half_columns; x < sensor.width - half_columns; ++x) {
        const float start = coarse(x / 2, y / kSearchStep);
        const float spread = light.spread(x - half_columns, top);
        if (std::isnan(start) || spread < least_spread ||
            spread < least_spread_of_sum * light.sum(x - half_columns, top))
          continue;
        row[x] = rows.climb(x - half_columns, top, static_cast<int>(std::lround(start * kPhases)));
      }
      believe(matcher, row, disparity.row(y));
    }
  });
  return disparity;
}

}  // namespace fathom
