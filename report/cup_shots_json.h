// shots.json of a diagnosis: the cup and a shot of each condition, for `fathom view`.
#pragma once

#include <filesystem>
#include <span>

#include "diagnosis/measurement/read_measurement.h"

namespace fathom {

inline constexpr const char* kShotsFile = "shots.json";
inline constexpr const char* kShotsBegin = R"({"cup":{"inner_profile_mm":)";  ///< by which ours is known

/// `folders` as they were read.
void write_cup_shots(const std::filesystem::path& folder, const Measurement& measurement,
                     std::span<const std::filesystem::path> folders);

}  // namespace fathom
