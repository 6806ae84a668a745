#include "sim/sensor/window_sums.h"

#include <cassert>
#include <cstring>

#include "core/simd.h"

namespace fathom {
namespace {

constexpr int kBlock = 8;

constexpr int kPairs = kTileColumns + kRefineColumns / 2;  ///< pairs of columns that a tile's windows meet
static_assert(kPairs == 3 * kBlock && kTileColumns == 2 * kBlock && kRefineColumns == 16);

/// Sums of pairs of columns over the rows above, from the tile's first row on.
using PairSums = float[kTileRows + kRefineRows][kWindowSums][kPairs];

inline __attribute__((always_inline)) void load(const float* from, Float8& block) {
  std::memcpy(&block, from, sizeof(block));
}
inline __attribute__((always_inline)) void store(const Float8& block, float* to) {
  std::memcpy(to, &block, sizeof(block));
}
/// The odd and the even column of each of a block's pairs.
inline __attribute__((always_inline)) void load_row(const TileImage& image, int row, int begin, Float8& odd,
                                                    Float8& even) {
  load(image.odd + row * image.stride + begin, odd), load(image.even + row * image.stride + begin, even);
}

/// Adds up the products of a block of pairs, row after row; in two rounds, each of which fits the registers.
inline __attribute__((always_inline)) void sum_pairs(const TileImage& live, const TileImage& reference,
                                                     const TileImage& gradient, int begin, int rows, PairSums& sums) {
  Float8 a, b, c, d, e, f;
  Float8 i{}, ii{}, ir{}, ig{};
  for (int row = 0;; ++row) {
    float(&of)[kWindowSums][kPairs] = sums[row];
    store(i, of[kI] + begin), store(ii, of[kII] + begin), store(ir, of[kIR] + begin), store(ig, of[kIG] + begin);
    if (row == rows) break;
    load_row(live, row, begin, a, b), load_row(reference, row, begin, c, d), load_row(gradient, row, begin, e, f);
    i += a + b, ii += a * a + b * b, ir += a * c + b * d, ig += a * e + b * f;
  }
  Float8 column;
  for (int k = 0; k < kBlock; ++k) column[k] = static_cast<float>(2 * (begin + k));
  Float8 r{}, g{}, rr{}, rg{}, gg{}, gg_x{}, gg_y{};
  for (int row = 0;; ++row) {
    float(&of)[kWindowSums][kPairs] = sums[row];
    store(r, of[kR] + begin), store(g, of[kG] + begin), store(rr, of[kRR] + begin), store(rg, of[kRG] + begin);
    store(gg, of[kGG] + begin), store(gg_x, of[kGGx] + begin), store(gg_y, of[kGGy] + begin);
    if (row == rows) break;
    load_row(reference, row, begin, c, d), load_row(gradient, row, begin, e, f);
    const Float8 right = f * f, both = e * e + right;
    r += c + d, g += e + f, rr += c * c + d * d, rg += c * e + d * f;
    gg += both, gg_x += column * both + right, gg_y += static_cast<float>(row) * both;
  }
}

/// From pairs to windows: the sums over 8 pairs from each of 16 on, by doubling.
inline __attribute__((always_inline)) void sum_across(const float* above, const float* below, float* windows) {
  Float8 sum[3], before;
  for (int k = 0; k < 3; ++k) {
    load(below + k * kBlock, sum[k]), load(above + k * kBlock, before);
    sum[k] -= before;
  }
  Float8 further;
  for (int k = 0; k < 3; ++k) lanes_from<1>(sum[k], sum[k < 2 ? k + 1 : k], further), sum[k] += further;
  for (int k = 0; k < 3; ++k) lanes_from<2>(sum[k], sum[k < 2 ? k + 1 : k], further), sum[k] += further;
  for (int k = 0; k < 2; ++k) lanes_from<4>(sum[k], sum[k + 1], further), store(sum[k] + further, windows + k * kBlock);
}

}  // namespace

FATHOM_SIMD_CLONES
void sum_windows(const TileImage& live, const TileImage& reference, const TileImage& gradient, int rows,
                 TileSums& sums) {
  assert(0 < rows && rows <= kTileRows);
  PairSums pairs;
  for (int begin = 0; begin < kPairs; begin += kBlock)
    sum_pairs(live, reference, gradient, begin, rows + kRefineRows - 1, pairs);
  for (int y = 0; y < rows; ++y)
    for (int k = 0; k < kWindowSums; ++k) sum_across(pairs[y][k], pairs[y + kRefineRows][k], sums.of[y][k]);
}

}  // namespace fathom
