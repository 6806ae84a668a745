// The device's depth law in OpenNI2's words: "shifts", which are the codes of sim/sensor/depth from another origin.
//
// OpenNI2 takes a shift s to a depth by x = (s − PARAM_COEFF · CONST_SHIFT) / PARAM_COEFF − 0.375, the disparity from
// the reference plane in pixels of the 1280-wide imager, m = x · ZPPS and Z = SHIFT_SCALE · ZPD · LDDIS / (LDDIS − m),
// cut to whole units (XnShiftToDepth.cpp of OpenNI2's PS1080 driver). That is device_depth() of the code s −
// kShiftOfCodeZero.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/scene/rig.h"
#include "sim/sensor/depth.h"

namespace fathom {

inline constexpr int kConstShift = 200;
inline constexpr int kParamCoeff = 4;
inline constexpr int kShiftScale = 10;  ///< mm in the centimetres of ZPD, ZPPS and LDDIS
inline constexpr int kMaxShift = kNoShift;
static_assert(kShiftOfCodeZero == kParamCoeff * kConstShift + 2);

/// Depth in whole multiples of `unit` [m] for every shift 0 … kMaxShift; 0 where there is none between near and far.
std::vector<std::uint16_t> shift_to_depth(const SensorModel& sensor, double unit);

/// The farthest shift whose depth is at most that, for every depth 0 … `max_depth` of the other table; 0 below its
/// least.
std::vector<std::uint16_t> depth_to_shift(const std::vector<std::uint16_t>& shift_to_depth, int max_depth);

}  // namespace fathom
