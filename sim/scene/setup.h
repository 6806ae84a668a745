// A scene file read whole: what stands there, who looks at it, and which effects are switched on.
#pragma once

#include <filesystem>

#include "sim/scene/rig.h"
#include "sim/scene/scene.h"

namespace fathom {

struct Setup {
  Scene scene;
  Rig rig;
  Json source;  ///< the file's text, kept for run.json
};

/// Reads a scene file. Throws Error naming file, path, what is wrong and what is allowed.
Setup read_setup(const std::filesystem::path& path);
Setup setup_from_json(const Json& json, const std::string& file);

/// Throws Error, as coming from `json`, when the medium's numbers do not hold at the sensor's wavelength.
void require_index(const JsonReader& json, const Medium& medium, double wavelength_nm);

}  // namespace fathom
