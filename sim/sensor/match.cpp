#include "sim/sensor/match.h"

#include <algorithm>

#include "sim/sensor/depth.h"

namespace fathom {

Match match(const SensorModel& sensor, const Image<float>& ir, const Reference& reference) {
  const Image<float> paired = rows_in_pairs(ir);
  const Image<float> coarse = search(sensor, paired, reference);
  Image<Estimate> estimates = refine(sensor, paired, reference, coarse);
  carry_to_pixels(estimates);
  settle_edges(sensor, paired, reference, estimates);

  const float at_reference = static_cast<float>(disparity_of_depth(sensor, sensor.reference));
  Match result{Image<float>(sensor.width, sensor.height), Image<float>(sensor.width, sensor.height)};
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const Estimate& estimate = estimates.pixels()[i];
    if (!estimate.valid()) continue;
    result.disparity_px.pixels()[i] = std::max(at_reference + estimate.disparity, 0.0f);
    result.correlation.pixels()[i] = estimate.correlation;
  }
  return result;
}

}  // namespace fathom
