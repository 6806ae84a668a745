// Things on the desk that are no cups: meshes of glTF files, boxes, bodies of revolution, cups turned over.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/scene.h"

namespace fathom {

/// "box.glb", "can"
std::string object_name(const Object& object);

/// Its triangles, in the world. Throws Error when its glTF file cannot be read.
std::vector<GltfPart> object_parts(const Object& object);

}  // namespace fathom
