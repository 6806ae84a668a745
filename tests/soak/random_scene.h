// Scenes that nobody would think of, as scene files.
#pragma once

#include <cstdint>
#include <filesystem>

#include "core/json.h"
#include "sim/sensor/capture.h"

namespace fathom {

/// How one scene is shot.
struct RandomShot {
  CaptureMode mode;
  LightModel light;
};

/// Writes `folder`/scene.json, and glTF files beside it where the scene has any, and says how to shoot it: small
/// images of up to three cups of any kind with any liquid, and objects. The same seed and number, the same scene.
RandomShot write_random_scene(std::uint64_t seed, std::uint64_t number, const std::filesystem::path& folder);

}  // namespace fathom
