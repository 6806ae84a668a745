#include "sim/sensor/device_outputs.h"

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

}  // namespace fathom
