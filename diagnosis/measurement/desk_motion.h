// Whether the desk moves from frame to frame beyond what the noise of its parts makes: as a whole, or in waves that run
// along the rows.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "diagnosis/measurement/frame_estimates.h"
#include "diagnosis/measurement/laboratory_rig.h"
#include "diagnosis/measurement/named_values.h"
#include "diagnosis/statistics/evidence.h"

namespace fathom {

/// A variance beyond what is known to make one.
struct VarianceExcess {
  double value = 0.0;
  double error = 0.0;     ///< 1 σ where nothing else makes one
  double sampling = 0.0;  ///< 1 σ besides where something does: few trials are of it
};

/// The excess as an observation in its root's unit: the root, negative where that is more which is known to make one;
/// beside chance as significant as the variance is, and never less uncertain than the root of its error. What it could
/// have been in other trials makes half its relative error, as of any root. `estimates`: how many numbers the variance
/// is of.
Observation root_of(const VarianceExcess& excess, std::string observable, Factors factors, int estimates);

/// Of the trials of one placement, all of the region "desk". "desk_rows_px", "desk_columns_px": by how much the mean
/// disparities of bands of 40 rows and of 40 columns scatter between trials once each frame's plane is taken off: roots
/// of variances, both as of bands of 25,600 pixels; noise of no direction makes them alike. "desk_turn_deg": by
/// how much the slope of its disparities over the rows scatters between trials, as the pitch that makes it.
/// "desk_height_noise_mm", "desk_turn_noise_deg", "desk_roll_noise_deg": by how much the fitted desk should scatter for
/// the noise of its parts, 1 σ of one trial, from how the thirds' mean disparities scatter, each by its number of
/// pixels, and where the desk was seen. Nothing of fewer than two trials, or where too little of the desk is seen in
/// any of them.
std::vector<NamedValue> scatter_values(std::span<const DeskBands> trials, const LaboratoryRig& rig);

/// Bare-desk observations, at the session's start; four for each session with enough repeats, or for each part of a
/// single one, three at most, of four placements at least. "desk_wander_mm": the root of the variance by which the
/// desk's height differs between trials, less that which follows from how the thirds of the image scatter.
/// "desk_waves_px": the same of the mean disparity of 40 rows, less that of as many pixels in columns.
/// "desk_pitch_motion_deg", "desk_roll_motion_deg": as the first, of the desk's turn and of the camera's roll: of a
/// sensor that trembles, or of rows that are sheared. Wander and pitch are uncertain by what waves along the rows may
/// make of them, the wander also by what a desk that turns makes of it. Negative where that is more.
std::vector<Observation> desk_motion(const std::vector<Observation>& observations, const LaboratoryRig& rig);

}  // namespace fathom
