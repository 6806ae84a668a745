#include "sim/sensor/window_sums.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "core/simd.h"

namespace fathom {
namespace {

/// Columns are taken in whole blocks of one register; remainders would cost the most on short runs.
constexpr int kBlock = 8;
using Block = float __attribute__((vector_size(kBlock * sizeof(float))));

constexpr int kMostColumns = 2 * (kRunWindows - 1) + kRefineColumns;
constexpr int kPadded = (kMostColumns / kBlock + 3) * kBlock;

struct ColumnSums {
  float of[kWindowSums][kPadded];
};

inline __attribute__((always_inline)) void load(const float* from, Block& block) {
  std::memcpy(&block, from, sizeof(block));
}
inline __attribute__((always_inline)) void store(const Block& block, float* to) {
  std::memcpy(to, &block, sizeof(block));
}

/// Products of each column of a block, summed over the window's rows; in two rounds, each of which fits the registers.
inline __attribute__((always_inline)) void sum_columns(const WindowRows& live, const WindowRows& reference,
                                                       const WindowRows& gradient, int begin, ColumnSums& sums) {
  const float *i = live.first + begin, *r = reference.first + begin, *g = gradient.first + begin;
  Block a, b, c;
  Block sum_i{}, ii{}, ir{}, ig{};
  for (int row = 0; row < kRefineRows; ++row) {
    load(i + row * live.stride, a), load(r + row * reference.stride, b), load(g + row * gradient.stride, c);
    sum_i += a, ii += a * a, ir += a * b, ig += a * c;
  }
  store(sum_i, sums.of[kI] + begin), store(ii, sums.of[kII] + begin);
  store(ir, sums.of[kIR] + begin), store(ig, sums.of[kIG] + begin);

  Block sum_r{}, sum_g{}, rr{}, rg{}, gg{}, gg_y{};
  for (int row = 0; row < kRefineRows; ++row) {
    load(r + row * reference.stride, b), load(g + row * gradient.stride, c);
    const Block cc = c * c;
    sum_r += b, sum_g += c, rr += b * b, rg += b * c, gg += cc, gg_y += static_cast<float>(row) * cc;
  }
  store(sum_r, sums.of[kR] + begin), store(sum_g, sums.of[kG] + begin);
  store(rr, sums.of[kRR] + begin), store(rg, sums.of[kRG] + begin);
  store(gg, sums.of[kGG] + begin), store(gg_y, sums.of[kGGy] + begin);
}

/// Pairs of columns from a block and the next: the sum of each pair, and its right column alone.
inline __attribute__((always_inline)) void add_pairs(const float* from, Block& pairs, Block& right) {
  using Index = int __attribute__((vector_size(sizeof(Block))));
  Block low, high;
  load(from, low), load(from + kBlock, high);
  right = __builtin_shuffle(low, high, Index{1, 3, 5, 7, 9, 11, 13, 15});
  pairs = __builtin_shuffle(low, high, Index{0, 2, 4, 6, 8, 10, 12, 14}) + right;
}

/// From the columns' sums to those of pairs of columns; kGGx counts the right one as 1.
inline __attribute__((always_inline)) void pair_columns(ColumnSums& sums, int begin) {
  Block pairs, right;
  for (int sum = 0; sum < kGGx; ++sum) {
    add_pairs(sums.of[sum] + 2 * begin, pairs, right);
    store(pairs, sums.of[sum] + begin);
    if (sum == kGG) store(right, sums.of[kGGx] + begin);
  }
}

/// From sums over `width` pairs to sums over twice as many, for the block of first pairs from `begin` on.
inline __attribute__((always_inline)) void double_width(ColumnSums& sums, int width, int begin) {
  Block left, right, gg;
  // The right half's columns count 2 width more: Σ (k + 2 width) g² = Σ k g² + 2 width Σ g².
  load(sums.of[kGGx] + begin, left), load(sums.of[kGGx] + begin + width, right), load(sums.of[kGG] + begin + width, gg);
  store(left + (right + static_cast<float>(2 * width) * gg), sums.of[kGGx] + begin);
  for (int sum = 0; sum < kGGx; ++sum) {
    load(sums.of[sum] + begin, left), load(sums.of[sum] + begin + width, right);
    store(left + right, sums.of[sum] + begin);
  }
}

}  // namespace

FATHOM_SIMD_CLONES
void sum_windows(WindowRows live, WindowRows reference, WindowRows gradient, int windows, int place,
                 Image<float>& sums) {
  static_assert((kRefineColumns & (kRefineColumns - 1)) == 0, "the width is reached by doubling");
  assert(0 < windows && windows <= kRunWindows);
  ColumnSums columns;
  const int count = 2 * (windows - 1) + kRefineColumns;
  for (int begin = 0; begin < count; begin += kBlock)  // the last block stays inside the image
    sum_columns(live, reference, gradient, std::min(begin, count - kBlock), columns);
  for (auto& of : columns.of) std::fill_n(of + count, 2 * kBlock, 0.0f);
  for (int begin = 0; begin < count / 2; begin += kBlock) pair_columns(columns, begin);
  for (int width = 1; width < kRefineColumns / 2; width *= 2)
    for (int begin = 0; begin <= count / 2 - 2 * width; begin += kBlock) double_width(columns, width, begin);
  for (int sum = 0; sum < kWindowSums; ++sum) std::copy_n(columns.of[sum], windows, sums.row(sum) + place);
}

}  // namespace fathom
