// Places of cups that were written down in another way: a flipped axis, another unit, the cup's front for its axis.
#pragma once

#include <array>
#include <span>

#include "diagnosis/measurement/frame_estimates.h"
#include "diagnosis/measurement/read_measurement.h"

namespace fathom {

/// Laterals of the other sign, in centimetres, inches and metres; distances to the cup's front.
inline constexpr std::size_t kPlaceReadings = 5;

/// Of one frame: whether its cup is not where it should be by the written place, but is by each other reading of it.
using StandsElsewhere = std::array<bool, kPlaceReadings>;
StandsElsewhere stands_elsewhere(std::span<const SensedPoint> points, const LaboratoryRig& rig,
                                 const FrameRecord& frame, const std::optional<FrameEstimates>& as_written);

/// Where at least four cups of a session, and half of those that a reading moves, stand as that reading says, the
/// session's places are changed and a mistake is added. Returns whether any are. `frames`: one of each of the
/// measurement's.
bool put_places_right(std::span<const StandsElsewhere> frames, Measurement& measurement);

}  // namespace fathom
