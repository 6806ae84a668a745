// Opaque objects from glTF 2.0 files (.gltf or .glb).
#pragma once

#include <filesystem>
#include <vector>

#include "sim/scene/mesh.h"

namespace fathom {

/// The triangles of one material, all instances in the file's scene.
struct GltfPart {
  Mesh mesh;      ///< [m], z up: glTF's (x, y, z) became (x, −z, y)
  double albedo;  ///< luminance (Rec. 709) of the material's base colour factor
};

/// Reads the default scene's triangle meshes with their node transformations. Throws Error on files that cannot be
/// read, have no triangles, indices out of range, non-finite positions, or transmissive materials (not modelled yet).
std::vector<GltfPart> read_gltf(const std::filesystem::path& path);

}  // namespace fathom
