// How one sensor differs from its model: what its calibration missed, and warming up.
#pragma once

#include <cstdint>

#include "core/json.h"

namespace fathom {

/// Errors of the disparity beside its nominal value.
struct UnitModel {
  double disparity_sigma_px = 0.0;  ///< spread of the reference's disparity from unit to unit
  double scale_sigma = 0.0;         ///< relative spread of focal length times baseline
  std::uint64_t serial = 0;         ///< of this unit, which draws its errors
  double warm_up_px = 0.0;          ///< what a cold unit's disparity has too much
  double warm_up_s = 940.0;         ///< in which that falls to 1/e
  double on_for_s = 1e9;            ///< since the unit was switched on, at frame 0
};

/// Measured disparity = scale · true + offset [px].
struct UnitError {
  double scale = 1.0, offset_px = 0.0;
};
/// Of the frame of that number at 30 a second.
UnitError unit_error(const UnitModel& unit, std::uint64_t frame);

UnitModel unit_from_json(const JsonReader& json, UnitModel unit);
Json json_from_unit(const UnitModel& unit);

}  // namespace fathom
