#include "sim/scene/mesh.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace fathom {
namespace {

Eigen::Vector3d on_circle(double radius, double height, int facet) {
  const double angle = 2.0 * std::numbers::pi * facet / kFacetsAround;
  return {radius * std::cos(angle), radius * std::sin(angle), height};
}

}  // namespace

std::vector<Eigen::Vector3d> vertex_normals(const Mesh& mesh) {
  std::vector<Eigen::Vector3d> normals(mesh.vertices.size(), Eigen::Vector3d::Zero());
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.vertices[triangle[0]];
    const Eigen::Vector3d area = (mesh.vertices[triangle[1]] - a).cross(mesh.vertices[triangle[2]] - a);
    for (const int corner : triangle) normals[corner] += area;
  }
  for (Eigen::Vector3d& normal : normals) normal.normalize();
  return normals;
}

Mesh revolve(const std::vector<Eigen::Vector2d>& profile, bool outward) {
  Mesh mesh;
  for (const Eigen::Vector2d& point : profile)
    for (int facet = 0; facet < kFacetsAround; ++facet) mesh.add_vertex(on_circle(point.x(), point.y(), facet));
  const auto add = [&](int a, int b, int c) { outward ? mesh.add_triangle(a, b, c) : mesh.add_triangle(a, c, b); };
  for (int ring = 0; ring + 1 < static_cast<int>(profile.size()); ++ring) {
    const bool from_axis = profile[ring].x() == 0.0, to_axis = profile[ring + 1].x() == 0.0;
    for (int facet = 0; facet < kFacetsAround; ++facet) {
      const int next = (facet + 1) % kFacetsAround;
      const int low = ring * kFacetsAround, high = low + kFacetsAround;
      if (!from_axis) add(low + facet, low + next, high + next);
      if (!to_axis) add(low + facet, high + next, high + facet);
    }
  }
  return mesh;
}

}  // namespace fathom
