#include "openni2/shift_tables.h"

#include "core/image.h"
#include "sim/sensor/depth.h"

namespace fathom {

std::vector<std::uint16_t> shift_to_depth(const SensorModel& sensor, double unit) {
  Image<float> depth(kMaxShift + 1, 1);
  for (int shift = 0; shift < kMaxShift; ++shift) {
    const auto metres = device_depth(sensor, shift - kShiftOfCodeZero, cut_of(sensor, unit));
    if (metres && *metres >= sensor.law.near && *metres <= sensor.law.far)
      depth(shift, 0) = static_cast<float>(*metres);
  }
  const Image<std::uint16_t> whole = depth_in_units(depth, unit);
  return {whole.pixels().begin(), whole.pixels().end()};
}

std::vector<std::uint16_t> depth_to_shift(const std::vector<std::uint16_t>& shift_to_depth, int max_depth) {
  std::vector<std::uint16_t> shifts;
  std::uint16_t farthest = 0;
  std::size_t shift = 0;
  for (int depth = 0; depth <= max_depth; ++depth) {
    for (; shift < shift_to_depth.size() && shift_to_depth[shift] <= depth; ++shift)
      if (shift_to_depth[shift] > 0) farthest = static_cast<std::uint16_t>(shift);
    shifts.push_back(farthest);
  }
  return shifts;
}

}  // namespace fathom
