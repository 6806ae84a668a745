// Whether a campaign can be diagnosed at all.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/statistics/evidence.h"

namespace fathom {

inline constexpr std::size_t kFewestConditions = 3;
inline constexpr std::size_t kFewestReplicates = 4;  ///< measured anew; what they differ by tells how large errors are
/// From so many observations on, what a smooth function of the factors leaves tells the same.
inline constexpr std::size_t kEnoughForSmooth = 24;

/// What is missing, one sentence each; nothing if it is enough. Asked for are eight observations in three conditions,
/// a candidate, and something that tells how large errors are: repeats, replicates or prior nuisances. One view of a
/// bare desk by a calibrated sensor is enough: rig, calibration and model say how far it may be off.
std::vector<std::string> missing_for_diagnosis(const Evidence& evidence);

}  // namespace fathom
