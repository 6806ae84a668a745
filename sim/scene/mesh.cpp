#include "sim/scene/mesh.h"

#include <Eigen/Geometry>

namespace fathom {

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

}  // namespace fathom
