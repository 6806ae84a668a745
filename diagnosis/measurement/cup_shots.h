// One shot of each condition, for people to look at: the points about its cup, as the heights are taken from them.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "diagnosis/measurement/read_measurement.h"

namespace fathom {

struct CupShot {
  const FrameRecord* frame;  ///< of the measurement
  Points points;             ///< [m] from below the cup's nominal axis: right, away, above the fitted desk
  Eigen::Vector3d camera;    ///< [m] the same
};

/// Of each liquid, fill and place the first cloud that shows the desk, the unit's bias taken off. `folders` as they
/// were read; `most`: points of all shots together, of which all have about as many.
std::vector<CupShot> cup_shots(const Measurement& measurement, std::span<const std::filesystem::path> folders,
                               std::size_t most);

}  // namespace fathom
