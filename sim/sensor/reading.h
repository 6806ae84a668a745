// What one device reads where light comes from a given depth: its lenses, its calibration, its unit.
#pragma once

#include <Eigen/Core>

#include "sim/scene/rig.h"

namespace fathom {

/// Disparity relative to infinity [px] of a point at `depth` [m] that is seen at `pixel_px`. A distorted image is
/// compared with one of the reference plane that is distorted alike: only what changes between the two places counts.
double seen_disparity(const SensorModel& sensor, const Eigen::Vector2d& pixel_px, double depth);

/// What the unit makes of a disparity relative to infinity [px]. It measures from the reference plane, whose distance
/// it knows: a wrong focal length or baseline does no harm there.
double read_disparity(const SensorModel& sensor, const UnitError& error, double disparity_px);

}  // namespace fathom
