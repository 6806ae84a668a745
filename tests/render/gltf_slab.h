// Writes bodies of a clear medium as glTF.
#pragma once

#include <array>
#include <cstring>
#include <filesystem>

#include "core/files.h"
#include "core/json.h"
#include "sim/scene/mesh.h"

namespace fathom {

/// A closed prism about the z axis with `sides` corners at `radius`, from z = `low` to `high` [m], outside out.
inline Mesh prism(int sides, double radius, double low, double high) {
  Mesh mesh;
  mesh.add_vertex({0.0, 0.0, low});
  mesh.add_vertex({0.0, 0.0, high});
  for (int i = 0; i < sides; ++i) {
    const Eigen::Vector2d xy = radius * direction_of(2.0 * std::numbers::pi * i / sides);
    for (const double z : {low, high}) mesh.add_vertex({xy.x(), xy.y(), z});
  }
  for (int i = 0; i < sides; ++i) {
    const int a = 2 + 2 * i, b = 2 + 2 * ((i + 1) % sides);
    mesh.add_triangle(0, b, a);
    mesh.add_triangle(1, a + 1, b + 1);
    mesh.add_triangle(a, b, b + 1);
    mesh.add_triangle(a, b + 1, a + 1);
  }
  return mesh;
}

/// FOLDER/body.gltf with its buffer beside it: +Y up, a transmissive material of that index and absorption. `normals`
/// by vertex, or none.
inline std::filesystem::path write_clear_gltf(const std::filesystem::path& folder, const Mesh& mesh, double index,
                                              double absorption_per_mm,
                                              const std::vector<Eigen::Vector3d>& normals = {}) {
  std::string bytes;
  const auto put = [&](const auto& values) {
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values[0]));
  };
  const auto put_vectors = [&](const std::vector<Eigen::Vector3d>& vectors) {
    for (const Eigen::Vector3d& v : vectors)
      put(std::array{static_cast<float>(v.x()), static_cast<float>(v.z()), static_cast<float>(-v.y())});
  };
  put_vectors(mesh.vertices);
  const std::size_t positions = bytes.size();
  for (const Eigen::Vector3i& t : mesh.triangles) put(std::array{t[0], t[1], t[2]});
  const std::size_t indices = bytes.size() - positions;
  put_vectors(normals);
  Json json =
      Json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}]})");
  json["materials"] = {
      {{"extensions",
        {{"KHR_materials_transmission", {{"transmissionFactor", 1}}}, {"KHR_materials_ior", {{"ior", index}}}}},
       {"extras", {{"absorption_per_mm", absorption_per_mm}}}}};
  json["accessors"] = {
      {{"bufferView", 0}, {"componentType", 5126}, {"count", mesh.vertices.size()}, {"type", "VEC3"}},
      {{"bufferView", 1}, {"componentType", 5125}, {"count", 3 * mesh.triangles.size()}, {"type", "SCALAR"}}};
  json["bufferViews"] = {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", positions}},
                         {{"buffer", 0}, {"byteOffset", positions}, {"byteLength", indices}}};
  if (!normals.empty()) {
    json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 2;
    json["accessors"].push_back(
        {{"bufferView", 2}, {"componentType", 5126}, {"count", normals.size()}, {"type", "VEC3"}});
    json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", positions + indices}, {"byteLength", bytes.size() - positions - indices}});
  }
  json["buffers"] = {{{"uri", "body.bin"}, {"byteLength", bytes.size()}}};
  write_text(folder / "body.bin", bytes);
  write_text(folder / "body.gltf", json.dump());
  return folder / "body.gltf";
}

}  // namespace fathom
