// The part of a check that looks at clouds: all their files, few of their points.
#pragma once

#include <string_view>

#include "diagnosis/measurement/check.h"

namespace fathom {

/// Throws Error on files of a column that are missing or empty, and counts them: read_frames() would tell of the first
/// alone.
void require_files(const Table& table, std::string_view column, const std::filesystem::path& folder);

/// Reads some of the clouds, and adds what they show otherwise than the notes. Throws Error where most of them show no
/// desk, or no cup.
void check_clouds(const std::filesystem::path& folder, const Table& table, const std::vector<FrameRecord>& frames,
                  MeasurementCheck& check);

}  // namespace fathom
