#include "sim/sensor/local_contrast.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/parallel.h"
#include "core/simd.h"

namespace fathom {
namespace {

constexpr int kMostRows = 31;  ///< of a window

template <int kRows>
inline __attribute__((always_inline)) void sum_rows_of(const float* const* rows, int count, float* __restrict sums,
                                                       float* __restrict squares, int width) {
  for (int x = 0; x < width; ++x) {
    float sum = 0.0f, square = 0.0f;
    for (int j = 0; j < (kRows > 0 ? kRows : count); ++j) {
      const float value = rows[j][x];
      sum += value, square += value * value;
    }
    sums[x] = sum, squares[x] = square;
  }
}

/// Sums of each column over `count` rows, and of the squares.
FATHOM_SIMD_CLONES
void sum_rows(const float* const* rows, int count, float* sums, float* squares, int width) {
  if (count == 9)  // the device's window: the inner loop unrolls
    sum_rows_of<9>(rows, count, sums, squares, width);
  else
    sum_rows_of<0>(rows, count, sums, squares, width);
}

template <int kColumns>
inline __attribute__((always_inline)) void slide_window_of(const float* __restrict framed, float* __restrict sums,
                                                           int window, int width) {
  for (int x = 0; x < width; ++x) {
    float sum = framed[x];
    for (int i = 1; i < (kColumns > 0 ? kColumns : window); ++i) sum += framed[x + i];
    sums[x] = sum;
  }
}

/// Sums over `window` columns from each on.
FATHOM_SIMD_CLONES
void slide_window(const float* framed, float* sums, int window, int width) {
  if (window == 9)
    slide_window_of<9>(framed, sums, window, width);
  else
    slide_window_of<0>(framed, sums, window, width);
}

FATHOM_SIMD_CLONES
void normalise_row(const float* __restrict row, const float* __restrict sums, const float* __restrict squares,
                   const float* __restrict one_over_count, float least, float scale, float limit,
                   std::int16_t* __restrict result, int width) {
  for (int x = 0; x < width; ++x) {
    const float mean = sums[x] * one_over_count[x];
    const float variance = squares[x] * one_over_count[x] - mean * mean;
    const float deviation = std::sqrt(variance > least * least ? variance : least * least);
    float value = scale * (row[x] - mean) / deviation;
    value = value > limit ? limit : value;
    value = value < -limit ? -limit : value;
    result[x] = static_cast<std::int16_t>(static_cast<int>(value + 64.5f) - 64);
  }
}

FATHOM_SIMD_CLONES
void split_row(const std::int16_t* __restrict row, std::int16_t* __restrict even, std::int16_t* __restrict odd,
               int pairs) {
  for (int x = 0; x < pairs; ++x) even[x] = row[2 * x], odd[x] = row[2 * x + 1];
}

}  // namespace

SplitColumns<std::int16_t> locally_normalised(const Image<float>& image, const MatcherModel& matcher, int frame) {
  const int width = image.width(), columns = matcher.window_columns, rows = matcher.window_rows, half = columns / 2;
  const int pairs = (width + 1) / 2;
  // Largest amplitude for which columns · rows products fit 16 bits; a dot's centre stands about 2.8 deviations out.
  const float limit = std::floor(std::sqrt(32767.0f / static_cast<float>(columns * rows)));
  const float least = static_cast<float>(matcher.contrast_min);
  SplitColumns<std::int16_t> result{{pairs + frame, image.height()}, {pairs + frame, image.height()}};
  parallel_ranges(image.height(), [&](int begin, int end) {
    std::vector<float> column(width + 2 * half), column_square(width + 2 * half), sum(width), square(width),
        one_over_count(width);
    std::vector<std::int16_t> normalised(2 * pairs);
    std::array<const float*, kMostRows> window;
    for (int y = begin; y < end; ++y) {
      const int first = std::max(y - rows / 2, 0), last = std::min(y + rows / 2, image.height() - 1);
      for (int j = first; j <= last; ++j) window[j - first] = image.row(j);
      sum_rows(window.data(), last - first + 1, column.data() + half, column_square.data() + half, width);
      slide_window(column.data(), sum.data(), columns, width);
      slide_window(column_square.data(), square.data(), columns, width);
      for (int x = 0; x < width; ++x) {
        const int inside = std::min(x + half, width - 1) - std::max(x - half, 0) + 1;
        one_over_count[x] = 1.0f / static_cast<float>(inside * (last - first + 1));
      }
      normalise_row(image.row(y), sum.data(), square.data(), one_over_count.data(), least, limit / 2.8f, limit,
                    normalised.data(), width);
      split_row(normalised.data(), result.even.row(y) + frame / 2, result.odd.row(y) + frame / 2, pairs);
    }
  });
  return result;
}

}  // namespace fathom
