// The clouds of a calibration, as people name them.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "diagnosis/unit/calibration.h"

namespace fathom {

/// Whether a file stands for the clouds that it names: frames.csv.
bool is_table(const std::filesystem::path& file);

/// Clouds as they are named; of a table those of its column `cloud`, with their `time_s` where it is the only one and
/// all are of one session. `interval_s`: from one named cloud to the next, the first at 0; tables have their own times.
/// Throws Error on a table that cannot be read.
std::vector<CalibrationCloud> calibration_clouds(std::span<const std::filesystem::path> files,
                                                 std::optional<double> interval_s);

}  // namespace fathom
