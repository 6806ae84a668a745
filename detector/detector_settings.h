// The detector's configuration file.
#pragma once

#include <filesystem>
#include <string_view>

#include "core/json.h"
#include "detector/detector.h"

namespace fathom {

/// Reads the object's keys over the defaults; the templates are those it names (beside its file), else those that come
/// with the program. Throws Error on anything unknown or out of range.
DetectorSettings detector_settings(const JsonReader& json);

/// The same of a file. An empty path gives the defaults.
DetectorSettings detector_settings(const std::filesystem::path& config);

/// Two rising lengths [low, high] in mm, if the key is there.
void read_mm_range(const JsonReader& json, std::string_view key, double& low_m, double& high_m);

}  // namespace fathom
