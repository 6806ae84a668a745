// What a laboratory does not know exactly of its rig, and the effects that are errors of it.
#pragma once

#include <array>

namespace fathom {

/// A value of rig.json that an effect with one parameter, in the same unit, moves.
struct UncertainValue {
  const char* key;  ///< of the rig's sigma
  const char *effect, *parameter;
  double sigma;  ///< when the rig has none
  bool is_pose;  ///< set up anew for each session
};
inline constexpr std::array kUncertainRig{
    UncertainValue{"height_mm", "sensor_height", "height_mm", 0.5, true},
    UncertainValue{"pitch_deg", "sensor_pitch", "pitch_deg", 0.05, true},
    UncertainValue{"roll_deg", "sensor_roll", "roll_deg", 0.05, true},
    UncertainValue{"baseline_mm", "baseline", "baseline_mm", 0.05, false},
    UncertainValue{"focal_px", "focal_length", "focal_px", 0.4, false},
    UncertainValue{"disparity_offset_px", "disparity_offset", "offset_px", 0.02, false},
    UncertainValue{"bottom_mm", "cup_bottom_height", "height_mm", 0.1, false}};

}  // namespace fathom
