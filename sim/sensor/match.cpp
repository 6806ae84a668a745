#include "sim/sensor/match.h"

#include <algorithm>
#include <utility>

#include "sim/sensor/depth.h"

namespace fathom {

Match match(const SensorModel& sensor, const Image<float>& ir, const Reference& reference) {
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
  Match result{std::move(estimates.disparity), std::move(estimates.correlation)};
  for (float& disparity : result.disparity_px.pixels())
    disparity = std::isnan(disparity) ? 0.0f : std::max(at_reference + disparity, 0.0f);
  return result;
}

}  // namespace fathom
