// What a laboratory does not know exactly of its rig, and the effects that are errors of it.
#pragma once

#include <array>
#include <iterator>

#include "diagnosis/measurement/laboratory_rig.h"

namespace fathom {

/// A value of rig.json that an effect with one parameter, in the same unit, moves.
struct UncertainValue : RigValue {
  const char *effect, *parameter;
  bool is_pose;  ///< set up anew for each session
};
inline constexpr std::array kUncertainRig{UncertainValue{kRigValues[0], "sensor_height", "height_mm", true},
                                          UncertainValue{kRigValues[1], "sensor_pitch", "pitch_deg", true},
                                          UncertainValue{kRigValues[2], "sensor_roll", "roll_deg", true},
                                          UncertainValue{kRigValues[3], "baseline", "baseline_mm", false},
                                          UncertainValue{kRigValues[4], "focal_length", "focal_px", false},
                                          UncertainValue{kRigValues[5], "disparity_offset", "offset_px", false},
                                          UncertainValue{kRigValues[6], "cup_bottom_height", "height_mm", false}};
static_assert(kUncertainRig.size() == std::size(kRigValues));

}  // namespace fathom
