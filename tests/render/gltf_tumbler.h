// A clear cup of revolution as the glTF file of its triangles.
#pragma once

#include <Eigen/Geometry>

#include "sim/scene/cup_mesh.h"
#include "tests/render/gltf_slab.h"

namespace fathom {

enum class Shading {
  flat,   ///< light bends at each facet
  smooth  ///< normals at the vertices, a profile's corner having one for each piece
};

/// Writes FOLDER/body.gltf, as many facets around as the program's own cups have.
inline std::filesystem::path write_tumbler(const std::filesystem::path& folder, const CupShape& shape, double index,
                                           double absorption_per_mm, Shading shading) {
  Mesh mesh;
  std::vector<Eigen::Vector3d> normals;
  for (const WallPart& part : wall_parts(shape, 0.0)) {
    const Eigen::Vector3i& corner = part.mesh.triangles.front();
    const Eigen::Vector3d& a = part.mesh.vertices[corner[0]];
    const Eigen::Vector3d outside = (part.mesh.vertices[corner[1]] - a).cross(part.mesh.vertices[corner[2]] - a);
    for (const Eigen::Vector3d& vertex : part.mesh.vertices) {
      const Eigen::Vector2d radial = vertex.head<2>().normalized();
      const Eigen::Vector3d normal =
          part.cone ? Eigen::Vector3d(radial.x(), radial.y(), -part.cone->y()) : Eigen::Vector3d::UnitZ();
      const Eigen::Vector3d at_first =
          part.cone ? Eigen::Vector3d(a.x(), a.y(), -part.cone->y() * a.head<2>().norm()) : Eigen::Vector3d::UnitZ();
      normals.push_back((at_first.dot(outside) < 0.0 ? -normal : normal).normalized());
    }
    mesh.append(part.mesh);
  }
  if (shading == Shading::flat) normals.clear();
  return write_clear_gltf(folder, mesh, index, absorption_per_mm, normals);
}

}  // namespace fathom
