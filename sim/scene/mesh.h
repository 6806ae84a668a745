// Triangle meshes in metres.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/pose.h"

namespace fathom {

struct Mesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector3i> triangles;  ///< counter-clockwise seen from outside

  int add_vertex(const Eigen::Vector3d& vertex) {
    vertices.push_back(vertex);
    return static_cast<int>(vertices.size()) - 1;
  }
  void add_triangle(int a, int b, int c) { triangles.emplace_back(a, b, c); }

  void transform(const Pose& target_from_mesh) {
    for (Eigen::Vector3d& vertex : vertices) vertex = target_from_mesh * vertex;
  }
  void append(const Mesh& other) {
    const Eigen::Vector3i shift = Eigen::Vector3i::Constant(static_cast<int>(vertices.size()));
    vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const Eigen::Vector3i& triangle : other.triangles) triangles.emplace_back(triangle + shift);
  }

  bool operator==(const Mesh&) const = default;
};

/// Unit normals at the vertices, those of the triangles around each weighed by their areas: of a smooth mesh.
std::vector<Eigen::Vector3d> vertex_normals(const Mesh& mesh);

/// Facets around the axis. The sagitta of a 40 mm wall is then 40 mm · (1 − cos(π/256)) = 3 µm.
inline constexpr int kFacetsAround = 256;

/// What a profile of (radius, height) [m] sweeps about the z axis. With `outward` the faces of a profile that rises
/// look away from the axis (or down), otherwise towards it (or up).
Mesh revolve(const std::vector<Eigen::Vector2d>& profile, bool outward);

/// [bytes] of a mesh with normals, and of what the ray tracer makes of it: to be asked before it is made.
inline std::uint64_t traced_bytes(std::uint64_t vertices, std::uint64_t triangles) {
  constexpr std::uint64_t kVertex = 64;     // position and normal in double precision, position in single
  constexpr std::uint64_t kTriangle = 256;  // corners twice, and the tree of boxes
  return kVertex * vertices + kTriangle * triangles;
}

}  // namespace fathom
