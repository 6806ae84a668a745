#include "sim/sensor/device_outputs.h"

#include <cmath>

#include "core/parallel.h"
#include "sim/sensor/depth.h"

namespace fathom {

Image<std::uint16_t> shift_image(const SensorModel& sensor, const Image<float>& disparity_px) {
  const Image<float> depth = depth_image(sensor, disparity_px);
  Image<std::uint16_t> shifts(depth.width(), depth.height(), kNoShift);
  for (std::size_t i = 0; i < shifts.size(); ++i) {
    if (depth.pixels()[i] == 0.0f) continue;
    // From the disparity, not from the depth, which has lost up to a millimetre.
    const double exact_depth = depth_of_disparity(sensor, disparity_px.pixels()[i]);
    const int shift = device_code(sensor, exact_depth) + kShiftOfCodeZero;
    if (shift >= 0 && shift < kNoShift) shifts.pixels()[i] = static_cast<std::uint16_t>(shift);
  }
  return shifts;
}

Image<float> registered_to_colour(const SensorModel& sensor, const Image<float>& depth) {
  Image<float> registered(depth.width(), depth.height());
  parallel_ranges(depth.height(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < depth.width(); ++x) {
        const float z = depth(x, y);
        if (z <= 0.0f) continue;
        const int moved = static_cast<int>(std::floor(x + 0.5 - sensor.focal_px * kColourCamera / z));
        if (moved < 0 || moved >= depth.width()) continue;
        float& there = registered(moved, y);
        if (there == 0.0f || z < there) there = z;
      }
  });
  return registered;
}

}  // namespace fathom
