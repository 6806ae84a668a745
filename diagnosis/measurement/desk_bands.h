// Whether rows of the image move apart from frame to frame, as a sensor that shakes while they are exposed makes them.
#pragma once

#include <span>

#include "diagnosis/measurement/frame_estimates.h"
#include "diagnosis/measurement/named_values.h"

namespace fathom {

/// By how much the mean disparities of bands of 40 rows and of 40 columns scatter between trials once each frame's
/// plane is taken off [px]: roots of variances, both as of bands of 25,600 pixels. Noise of no direction makes them
/// alike.
struct BandScatter {
  double rows_px = 0.0, columns_px = 0.0;
};

/// Of the trials of one placement; nothing of fewer than two, or where too little of the desk is seen in any of them.
std::optional<BandScatter> scatter_of(std::span<const DeskBands> trials);

/// By how much the fitted desk should scatter between trials for the noise of its parts, 1 σ of one trial.
struct PlaneNoise {
  double height_mm = 0.0, pitch_deg = 0.0, roll_deg = 0.0;
};

/// From how the thirds' mean disparities scatter, each by its number of pixels, and where the desk was seen. Nothing of
/// fewer than two trials or five thirds.
std::optional<PlaneNoise> plane_noise_of(std::span<const DeskBands> trials, const LaboratoryRig& rig);

/// Both as values of a placement: "desk_rows_px", "desk_columns_px", "desk_height_noise_mm", "desk_pitch_noise_deg",
/// "desk_roll_noise_deg", all of the region "desk"; nothing unless both are there.
std::vector<NamedValue> scatter_values(std::span<const DeskBands> trials, const LaboratoryRig& rig);

}  // namespace fathom
