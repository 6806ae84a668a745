// Objects, opaque and clear, from glTF 2.0 files (.gltf or .glb).
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "sim/optics/medium.h"
#include "sim/scene/mesh.h"

namespace fathom {

/// A clear coat over an opaque surface, of which optics/glaze.h makes a glaze; the albedo that stands beside it is that
/// of the body within the coat.
struct Coat {
  double roughness;  ///< α of optics/ggx.h, at least kLeastRoughness
  double index = 1.5;

  bool operator==(const Coat&) const = default;
};

/// The highlight of a smoother coat on a wall of 40 mm, whose normal turns by this angle [rad] over 0.8 mm, would be
/// narrower than an infrared pixel from half a metre away.
inline constexpr double kLeastRoughness = 0.02;

/// Triangles that look alike: all of an opaque material, or those of one clear body.
struct GltfPart {
  Mesh mesh;  ///< [m], z up: glTF's (x, y, z) became (x, −z, y)
  /// By vertex, of clear and coated bodies; unit as read, empty where there are none.
  std::vector<Eigen::Vector3d> normals;
  double albedo = 0.0;           ///< luminance (Rec. 709) of an opaque material's base colour factor
  std::optional<Coat> coat;      ///< of an opaque material
  std::optional<Medium> medium;  ///< of a clear body (KHR_materials_transmission)
  int body = 0;                  ///< parts of equal number bound the same clear body

  void transform(const Pose& pose);  ///< `pose` without scaling

  bool operator==(const GltfPart&) const = default;
};

/// Reads the default scene's triangle meshes with their node transformations. A transmissive material makes each mesh
/// that a node places a clear body: index by KHR_materials_ior (1.5 without), absorption by KHR_materials_volume, or by
/// the material's `extras` (absorption_per_mm, scattering_per_mm, anisotropy), which win. An opaque material has a coat
/// where metallicFactor is 0 and roughnessFactor below 1, of glTF's α = roughnessFactor², or kLeastRoughness if that is
/// more, and of the same index; metals are Lambertian. Throws Error on files that
/// cannot be read, have no triangles, indices out of range, positions or normals that are not finite, values that are
/// out of range.
std::vector<GltfPart> read_gltf(const std::filesystem::path& path);

}  // namespace fathom
