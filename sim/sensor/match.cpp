#include "sim/sensor/match.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/parallel.h"
#include "sim/sensor/depth.h"

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

Image<float> match(const SensorModel& sensor, const Image<float>& ir, const Reference& reference) {
  const SplitColumns<float> paired = split_rows_in_pairs(ir);
  const Image<float> coarse = search(sensor, paired, reference);
  Estimates estimates(0, 0);
  if (sensor.matcher.method == MatchMethod::device) {
    estimates.disparity = block_match(sensor, mean_of_columns(paired, sensor.ir_width / 2), reference.blocks,
                                      reference.margin_px, coarse);
  } else {
    estimates = refine(sensor, paired, reference, coarse);
    carry_to_pixels(estimates);
    settle_edges(sensor, paired, reference, coarse, estimates);
  }
  fill_holes(sensor.matcher.hole_max_px, estimates.disparity);

  const float at_reference = static_cast<float>(disparity_of_depth(sensor, sensor.reference));
  for (float& disparity : estimates.disparity.pixels())
    disparity = std::isnan(disparity) ? 0.0f : std::max(at_reference + disparity, 0.0f);
  return std::move(estimates.disparity);
}

void fill_holes(int most_px, Image<float>& disparity) {
  if (most_px == 0) return;
  parallel_rows(disparity.height(), [&](int y) { fill_row(disparity.row(y), disparity.width(), most_px); });
}

}  // namespace fathom
