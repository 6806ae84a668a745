// The detector's configuration file.
#pragma once

#include <filesystem>
#include <vector>

#include "core/key_table.h"
#include "detector/detector.h"

namespace fathom {

/// Reads the keys of the file over the defaults; the templates are those it names (beside the file), else those that
/// come with the program. An empty path gives the defaults. Throws Error on anything unknown or out of range.
DetectorSettings read_detector_settings(const std::filesystem::path& path);

/// The file's objects.
std::vector<KeyTable> detector_key_tables();

}  // namespace fathom
