// A triangle mesh in metres.
#pragma once

#include <Eigen/Core>
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

}  // namespace fathom
