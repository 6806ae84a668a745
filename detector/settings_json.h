// The detector's configuration file.
#pragma once

#include <filesystem>
#include <vector>

#include "core/json_fwd.h"
#include "detector/detector.h"

namespace fathom {

/// Reads the object's keys over the defaults; the templates are those it names (beside its file), else those that come
/// with the program. Throws Error on anything unknown or out of range.
DetectorSettings detector_settings(const JsonReader& json);

/// The same of a file. An empty path gives the defaults.
DetectorSettings read_detector_settings(const std::filesystem::path& path);

/// The file's objects.
std::vector<KeyTable> detector_key_tables();

}  // namespace fathom
