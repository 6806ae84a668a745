// Sums over the refinement's windows: all that a least-squares shift needs from the live image and the reference.
#pragma once

#include <cstddef>

#include "core/image.h"
#include "sim/sensor/reference.h"

namespace fathom {

/// Sums over one window of the live image i, the reference r and its derivative g along x [1/px]; kGGx and kGGy are
/// Σ g² weighted by column and by row, both counted from 0.
enum WindowSum { kI, kII, kIR, kIG, kR, kG, kRR, kRG, kGG, kGGy, kGGx, kWindowSums };

/// Most windows of a run: their column sums fill a third of the first-level cache.
inline constexpr int kRunWindows = 64;

/// An image's rows from the first of a window on.
struct WindowRows {
  const float* first;
  std::ptrdiff_t stride;  ///< values from row to row
};

/// Sums over `windows` ≤ kRunWindows windows of kRefineColumns × kRefineRows, each two columns right of the one before,
/// all of them at the same shift between image and reference. Neighbouring windows share their columns, so the products
/// of each column are made once. A window's sums do not depend on where it stands in its run. `sums` has a row for each
/// WindowSum; the first window's go to column `place`.
void sum_windows(WindowRows live, WindowRows reference, WindowRows gradient, int windows, int place,
                 Image<float>& sums);

}  // namespace fathom
