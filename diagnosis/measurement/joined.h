// Several measurement directories of one laboratory as one measurement.
#pragma once

#include <filesystem>
#include <span>

#include "diagnosis/measurement/read_measurement.h"

namespace fathom {

/// Reads all folders; the sessions of each follow those of the one before. The rig is the first folder's, with the
/// liquids of all. Throws Error when another folder has another sensor, pose or cup, or another liquid by the same
/// name.
Measurement read_measurements(std::span<const std::filesystem::path> folders, bool quiet = true);

}  // namespace fathom
