// Meshes as glTF files, for tests of what reads them.
#pragma once

#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/files.h"
#include "core/json.h"
#include "sim/scene/mesh.h"

namespace fathom {

/// Writes `path` (*.gltf) and its buffer beside it, z up becoming +Y up; the material's base colour is `albedo`.
inline void write_gltf(const std::filesystem::path& path, const Mesh& mesh, double albedo = 0.7) {
  std::string bytes;
  const auto put = [&](auto value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
  };
  for (const Eigen::Vector3d& v : mesh.vertices)
    for (const double coordinate : {v.x(), v.z(), -v.y()}) put(static_cast<float>(coordinate));
  const std::size_t positions = bytes.size();
  for (const Eigen::Vector3i& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) put(static_cast<std::uint32_t>(t[i]));
  std::filesystem::path buffer = path;
  buffer.replace_extension(".bin");
  std::ofstream(buffer, std::ios::binary) << bytes;
  const Json json = {
      {"asset", {{"version", "2.0"}}},
      {"scenes", Json::array({{{"nodes", {0}}}})},
      {"nodes", Json::array({{{"mesh", 0}}})},
      {"meshes",
       Json::array(
           {{{"primitives", Json::array({{{"attributes", {{"POSITION", 0}}}, {"indices", 1}, {"material", 0}}})}}})},
      {"materials", Json::array({{{"pbrMetallicRoughness", {{"baseColorFactor", {albedo, albedo, albedo, 1.0}}}}}})},
      {"accessors",
       Json::array(
           {{{"bufferView", 0}, {"componentType", 5126}, {"count", mesh.vertices.size()}, {"type", "VEC3"}},
            {{"bufferView", 1}, {"componentType", 5125}, {"count", 3 * mesh.triangles.size()}, {"type", "SCALAR"}}})},
      {"bufferViews",
       Json::array({{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", positions}},
                    {{"buffer", 0}, {"byteOffset", positions}, {"byteLength", bytes.size() - positions}}})},
      {"buffers", Json::array({{{"uri", buffer.filename().string()}, {"byteLength", bytes.size()}}})}};
  write_text(path, json.dump());
}

}  // namespace fathom
