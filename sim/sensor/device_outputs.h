// What the real device can send instead of depths in metres (docs/files.md).
#pragma once

#include <cstdint>

#include "core/image.h"
#include "sim/scene/rig.h"

namespace fathom {

/// The raw shift of the code 0 of sim/sensor/depth: OpenNI's table takes a shift s to x = (s − 4 · 200) / 4 − 0.375 =
/// (code + ½) / 4.
inline constexpr int kShiftOfCodeZero = 4 * 200 + 2;
inline constexpr int kNoShift = 2047;  ///< nothing measured; also the first that 11 bits cannot hold

/// Raw shifts 0 … 2046 of disparities relative to infinity [px]; kNoShift where depth_image() has no depth.
Image<std::uint16_t> shift_image(const SensorModel& sensor, const Image<float>& disparity_px);

}  // namespace fathom
