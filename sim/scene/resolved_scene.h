// A scene file that needs no library and no folder but its own, for records that are moved elsewhere.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/setup.h"

namespace fathom {

/// A copy of a file that a scene names.
struct NamedFile {
  std::string name;  ///< relative to the scene file
  std::string content;
};

struct ResolvedScene {
  SharedJson scene;  ///< read as a scene file, with its effects switched on, it is the set-up again, bit for bit
  std::vector<NamedFile> files;
};

/// Below the folder of a resolved scene: where the files lie that it names.
inline constexpr const char* kSceneFiles = "scene_files";

/// What a set-up was read from, with all names of libraries replaced by what they stand for and the effects of a model
/// behind its own. Numbers stay as they were written, so none is rounded. Throws Error when a file cannot be read or
/// lies outside the folder of the glTF file that names it.
ResolvedScene resolved_scene(const Setup& setup);

}  // namespace fathom
