#include <cmath>

#include "core/parallel.h"
#include "sim/sensor/match.h"

namespace fathom {
namespace {

void fill_row(float* disparity, int width, int most_px) {
  constexpr float kSameSurface = 1.0f;  // [px] between the two sides; a step in depth that matters is larger
  int last = -1;                        // valid column, −1: none yet
  for (int x = 0; x < width; ++x) {
    if (std::isnan(disparity[x])) continue;
    const int gap = x - last - 1;
    const float rise = last < 0 ? 0.0f : disparity[x] - disparity[last];
    if (last >= 0 && gap > 0 && gap <= most_px && std::fabs(rise) < kSameSurface)
      for (int i = 1; i <= gap; ++i)
        disparity[last + i] = disparity[last] + rise * static_cast<float>(i) / static_cast<float>(gap + 1);
    last = x;
  }
}

}  // namespace

void fill_holes(int most_px, Image<float>& disparity) {
  if (most_px == 0) return;
  parallel_ranges(disparity.height(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y) fill_row(disparity.row(y), disparity.width(), most_px);
  });
}

}  // namespace fathom
