// A frame's estimates as observations name them: the one list of what measurement and prediction have in common.
#pragma once

#include <string_view>
#include <vector>

#include "diagnosis/measurement/frame_estimates.h"

namespace fathom {

struct NamedValue {
  std::string_view observable;  ///< with its unit: "height_mm"
  std::string_view region;      ///< of the cup or of the desk around it
  double value;
  double pixels = 0.0;  ///< that it is the mean of; 0: of no certain number
};

/// Pixels that a region of the cup needs.
inline constexpr double kFewestInRegion = 60.0;
/// … that the mean over all of its inside does, as tables without clouds have it, …
inline constexpr double kFewestInInterior = 10.0;
/// … and that a cell of its raster does.
inline constexpr double kFewestInCell = 15.0;

/// "height_mm" of every region of the cup with at least sixty pixels, and "stray_share", the share of its heights that
/// are too far from their median to count; of its walls "cup_x_mm", "cup_y_mm" (of the axis from where it should stand)
/// and "cup_radius_mm" (less the rig's); of the desk "desk_height_mm" (of the camera above it), "desk_pitch_deg",
/// "desk_roll_deg", "desk_residual_mm" of each third of the image with at least a hundred pixels, of the disparities'
/// fractions "comb_strength" (mean cosine: 1 on the device's steps, −1 half a step beside them),
/// "comb_quarter" and "comb_half" how far disparities keep to steps of 1/4 and 1/2 px, "millimetre_comb" of the depths'
/// in the first way; of the whole interior "height_sd_mm", "log_brightness", the natural logarithm of the brightness
/// inside over that of the desk, and "log_ir_contrast", the same of the contrast of the infrared's dots, where the desk
/// shows any; "cell_height_mm" of the cells of the cup's raster that show a surface.
std::vector<NamedValue> named_values(const FrameEstimates& estimates);

/// Whether a cell of the raster has enough heights for a mean, and few that stray from it.
bool is_surface(const RegionEstimate& cell);

/// Region of a cell's height.
std::string_view name_of_cell(int cell);

}  // namespace fathom
