#include "sim/scene/wetted_wall.h"

#include <Eigen/Geometry>
#include <map>
#include <tuple>

#include "sim/scene/mesh_topology.h"

namespace fathom {
namespace {

/// The triangles of a part on both sides of a level plane. Those that it cuts are divided, with new vertices on it.
class LevelCut {
 public:
  LevelCut(const GltfPart& part, double level) : part_(part), level_(level) {
    for (const Eigen::Vector3i& triangle : part.mesh.triangles) add(triangle);
  }

  const GltfPart& part() const { return part_; }  ///< with all vertices
  const std::vector<Eigen::Vector3i>& below() const { return below_; }
  const std::vector<Eigen::Vector3i>& above() const { return above_; }

 private:
  double height(int vertex) const { return part_.mesh.vertices[vertex].z() - level_; }

  void add(const Eigen::Vector3i& triangle) {
    std::vector<int> low, high;  // corners of the triangle's two parts
    for (int i = 0; i < 3; ++i) {
      const int a = triangle[i], b = triangle[(i + 1) % 3];
      if (height(a) <= 0.0) low.push_back(a);
      if (height(a) >= 0.0) high.push_back(a);
      if (height(a) * height(b) < 0.0) {
        low.push_back(vertex_between(a, b));
        high.push_back(low.back());
      }
    }
    const bool lies_in_plane = low.size() == 3 && high.size() == 3;
    if (!lies_in_plane) add_polygon(low, below_);
    add_polygon(high, above_);
  }

  static void add_polygon(const std::vector<int>& corners, std::vector<Eigen::Vector3i>& triangles) {
    for (std::size_t i = 2; i < corners.size(); ++i) triangles.emplace_back(corners[0], corners[i - 1], corners[i]);
  }

  /// Bit for bit the same from the triangles on both sides of the edge.
  int vertex_between(int a, int b) {
    std::vector<Eigen::Vector3d>& vertices = part_.mesh.vertices;
    if (height(a) > height(b)) std::swap(a, b);
    const double share = height(a) / (height(a) - height(b));
    const Eigen::Vector3d between = vertices[a] + share * (vertices[b] - vertices[a]);
    // A normal that is not of unit length leaves those interpolated on both sides as they were.
    if (!part_.normals.empty()) part_.normals.emplace_back((1.0 - share) * part_.normals[a] + share * part_.normals[b]);
    return part_.mesh.add_vertex({between.x(), between.y(), level_});
  }

  GltfPart part_;
  double level_;
  std::vector<Eigen::Vector3i> below_, above_;
};

/// Some of a part's triangles, with the vertices that they need.
class Selection {
 public:
  explicit Selection(const GltfPart& whole) : whole_(whole), number_(whole.mesh.vertices.size(), -1) {
    part_.medium = whole.medium;
    part_.body = whole.body;
  }

  void add(const Eigen::Vector3i& triangle) {
    for (const int corner : triangle) {
      if (number_[corner] >= 0) continue;
      number_[corner] = part_.mesh.add_vertex(whole_.mesh.vertices[corner]);
      if (!whole_.normals.empty()) part_.normals.push_back(whole_.normals[corner]);
    }
    part_.mesh.add_triangle(number_[triangle[0]], number_[triangle[1]], number_[triangle[2]]);
  }

  GltfPart take() { return std::move(part_); }

 private:
  const GltfPart& whole_;
  std::vector<int> number_;
  GltfPart part_;
};

/// For each patch whether its largest triangle looks into the liquid.
std::map<int, bool> wetted_patches(const Mesh& mesh, const std::vector<int>& patch_of, const Cavity& cavity,
                                   double level) {
  constexpr double kInFront = 1e-6;  // [m] above rounding, below any gap between wall and liquid
  const auto doubled_area = [&](std::size_t t) {
    const Eigen::Vector3i& corner = mesh.triangles[t];
    const Eigen::Vector3d& a = mesh.vertices[corner[0]];
    return Eigen::Vector3d((mesh.vertices[corner[1]] - a).cross(mesh.vertices[corner[2]] - a));
  };
  std::map<int, std::size_t> largest;
  for (std::size_t t = 0; t < patch_of.size(); ++t) {
    const auto [known, is_new] = largest.try_emplace(patch_of[t], t);
    if (!is_new && doubled_area(t).norm() > doubled_area(known->second).norm()) known->second = t;
  }
  std::map<int, bool> wetted;
  for (const auto& [patch, t] : largest) {
    const Eigen::Vector3i& corner = mesh.triangles[t];
    const Eigen::Vector3d centre =
        (mesh.vertices[corner[0]] + mesh.vertices[corner[1]] + mesh.vertices[corner[2]]) / 3.0;
    wetted[patch] = cavity.holds(centre + kInFront * doubled_area(t).normalized(), level);
  }
  return wetted;
}

}  // namespace

WettedWall cut_at_liquid(const GltfPart& part, const Cavity& cavity, double level) {
  const LevelCut cut(part, level);
  const Mesh below{cut.part().mesh.vertices, cut.below()};
  const std::vector<int> patch_of = patches(below);
  const std::map<int, bool> wetted = wetted_patches(below, patch_of, cavity, level);
  Selection dry(cut.part()), wet(cut.part());
  for (const Eigen::Vector3i& triangle : cut.above()) dry.add(triangle);
  for (std::size_t t = 0; t < patch_of.size(); ++t) (wetted.at(patch_of[t]) ? wet : dry).add(below.triangles[t]);
  return {dry.take(), wet.take()};
}

}  // namespace fathom
