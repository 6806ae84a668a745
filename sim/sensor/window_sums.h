// Sums over the refinement's windows: all that a least-squares shift needs from the live image and the reference.
#pragma once

#include <cstddef>

namespace fathom {

/// The refinement's window: 8 × 7 depth pixels, centred on its pixel.
inline constexpr int kRefineColumns = 16;  ///< infrared pixels
inline constexpr int kRefineRows = 7;      ///< row pairs

/// Windows are summed in tiles, all of them at the same shift between image and reference.
inline constexpr int kTileColumns = 16, kTileRows = 3;  ///< windows, one for each depth pixel

/// Sums over one window of the live image i, the reference r and its derivative g along x [1/px]; kGGx and kGGy are
/// Σ g² weighted by column [infrared px] and by row, both counted from the tile's first.
enum WindowSum { kI, kII, kIR, kIG, kR, kG, kRR, kRG, kGG, kGGx, kGGy, kWindowSums };

struct TileSums {
  float of[kTileRows][kWindowSums][kTileColumns];
};

/// An image's rows from a tile's first on: each window's columns are odd, even, odd, …, even.
struct TileImage {
  const float *odd, *even;
  std::ptrdiff_t stride;  ///< values from row to row
};

/// Sums over a tile's windows, `rows` ≤ kTileRows rows of them.
void sum_windows(const TileImage& live, const TileImage& reference, const TileImage& gradient, int rows,
                 TileSums& sums);

}  // namespace fathom
