// How one sensor differs from its model: what its calibration missed, and warming up.
#pragma once

#include <cstdint>
#include <span>

#include "core/image.h"
#include "core/json_fwd.h"
#include "core/unit_map.h"

namespace fathom {

/// Errors of the disparity beside its nominal value.
struct UnitModel {
  double disparity_offset_px = 0.0;  ///< what this unit's disparities have too much
  double disparity_sigma_px = 0.0;   ///< spread of the reference's disparity from unit to unit
  double scale_sigma = 0.0;          ///< relative spread of focal length times baseline
  std::uint64_t serial = 0;          ///< of this unit, which draws its errors
  double residue_px = 0.0;           ///< standard deviation, over the image, of what the reference is displaced by
  double residue_reach_px = 70.0;    ///< distance over which that changes
  double warm_up_px = 0.0;           ///< what a cold unit's disparity has too much
  double warm_up_s = 940.0;          ///< in which that falls to 1/e
  double on_for_s = 1e9;             ///< since the unit was switched on, at frame 0
  double wander_px = 0.0;            ///< standard deviation of an error that all disparities of a frame share
  double frame_interval_s = 1.0 / 30.0;
  LearnedUnit learned;  ///< what fathom calibrate found, beside what is drawn

  bool operator==(const UnitModel&) const = default;
};

/// Measured disparity = scale · true + offset [px].
struct UnitError {
  double scale = 1.0, offset_px = 0.0;

  bool operator==(const UnitError&) const = default;
};
/// Of the frame of that number.
UnitError unit_error(const UnitModel& unit, std::uint64_t frame);

/// What the reference image of this unit is displaced by along its rows [px], at each of its pixels: lenses and
/// pattern are not any more, or not at all distances, where they were when it was taken. A smooth normal field of
/// covariance residue_px² exp(−r² / 2 residue_reach_px²), width × height; empty: none. Column 0 lies `margin_px` left
/// of the image, whose rows lie in the middle. To this comes what was learned of the unit in the reference's frame.
Image<float> reference_residue(const UnitModel& unit, int margin_px, int width, int height);

/// A text is the path of a learned unit, which has nothing of a drawn residue.
UnitModel unit_from_json(const JsonReader& json, UnitModel unit);
std::span<const Field<UnitModel>> unit_fields();

}  // namespace fathom
