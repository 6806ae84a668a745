#include "sim/scene/gltf_export.h"

#include <fmt/format.h>

#include <utility>

#include "sim/scene/cup.h"
#include "sim/scene/cup_mesh.h"
#include "sim/scene/gltf_model.h"
#include "sim/scene/liquid_shell.h"
#include "sim/scene/liquid_top.h"
#include "sim/scene/object.h"

namespace fathom {
namespace {

/// The body under a liquid's surface; in a cup from a mesh its surface alone.
GltfPart liquid_part(const Cup& cup, double wavelength_nm) {
  const Medium& medium = cup.filling->medium;
  GltfPart part;
  if (medium.scatters())
    part.albedo = diffuse_reflectance(medium, medium.n(wavelength_nm));
  else
    part.medium = medium;
  const auto* shape = std::get_if<CupShape>(&cup.shape);
  if (!shape) {
    part.mesh = liquid_surface(cup);
  } else {
    const LiquidTop top(*shape, liquid_level(cup), cup.filling->form);
    part.mesh = top.mesh(*shape);
    part.mesh.append(liquid_shell(*shape, top, part.mesh));
    part.mesh.transform(Pose(Eigen::Translation3d(cup.position.x(), cup.position.y(), 0.0)));
  }
  return part;
}

/// Those of the smooth piece that its triangles stand for: means over triangles would lean by a part of a facet, and
/// glass would bend light by that.
std::vector<Eigen::Vector3d> exact_normals(const WallPart& wall) {
  const Mesh& mesh = wall.mesh;
  const Eigen::Vector3i first = mesh.triangles.front();
  const Eigen::Vector3d corner = mesh.vertices[first[0]];
  const Eigen::Vector3d facing =
      (mesh.vertices[first[1]] - corner).cross(mesh.vertices[first[2]] - corner).normalized();
  const auto smooth = [&](const Eigen::Vector3d& vertex) {
    const double radius = vertex.head<2>().norm();
    if (!wall.cone || radius == 0.0) return Eigen::Vector3d(0.0, 0.0, facing.z() < 0.0 ? -1.0 : 1.0);
    return Eigen::Vector3d(vertex.x() / radius, vertex.y() / radius, -wall.cone->y()).normalized();
  };
  std::vector<Eigen::Vector3d> normals;
  const double side = smooth(corner).dot(facing) < 0.0 ? -1.0 : 1.0;
  for (const Eigen::Vector3d& vertex : mesh.vertices) normals.push_back(side * smooth(vertex));
  return normals;
}

/// A cup of revolution piece by piece, so that each is smooth and edges stay sharp.
std::vector<GltfPart> wall_pieces(const Cup& cup) {
  const auto* shape = std::get_if<CupShape>(&cup.shape);
  if (!shape) return cup_parts(cup);
  std::vector<GltfPart> pieces;
  const auto add = [&](const Mesh& mesh, std::vector<Eigen::Vector3d> normals) {
    GltfPart& piece = pieces.emplace_back();
    piece.mesh = mesh;
    piece.normals = std::move(normals);
    piece.albedo = shape->albedo;
    piece.coat = shape->glaze;
    piece.medium = shape->material;
    piece.transform(world_from_shape(cup));
  };
  for (const WallPart& wall : wall_parts(*shape, 0.0)) add(wall.mesh, exact_normals(wall));
  if (shape->handle) {
    const Mesh handle = handle_mesh(*shape);
    add(handle, vertex_normals(handle));
  }
  return pieces;
}

GltfPart desk_part(const Desk& desk) {
  GltfPart part;
  part.albedo = desk.albedo;
  part.coat = desk.glaze;
  const Eigen::Vector2d low = desk.centre - 0.5 * desk.size, high = desk.centre + 0.5 * desk.size;
  for (const auto& [x, y] :
       {std::pair(low.x(), low.y()), {high.x(), low.y()}, {high.x(), high.y()}, {low.x(), high.y()}})
    part.mesh.add_vertex({x, y, 0.0});
  part.mesh.add_triangle(0, 1, 2);
  part.mesh.add_triangle(0, 2, 3);
  return part;
}

}  // namespace

std::string glb_of_scene(const Setup& setup) {
  const Scene& scene = setup.scene;
  GltfModel model(setup.rig.sensor.wavelength_nm);
  if (scene.desk) model.add("desk", {desk_part(*scene.desk)});
  for (std::size_t i = 0; i < scene.cups.size(); ++i) {
    const Cup& cup = scene.cups[i];
    model.add(fmt::format("cup {} {}", i, cup_name(cup)), wall_pieces(cup));
    if (cup.filling)
      model.add(fmt::format("cup {} {}", i, cup.filling->medium.name),
                {liquid_part(cup, setup.rig.sensor.wavelength_nm)});
  }
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    model.add(fmt::format("object {} {}", i, object_name(scene.objects[i])), object_parts(scene.objects[i]));
  model.add_camera("infrared camera", setup.rig);
  return model.bytes();
}

std::string glb_of_cup(const Cup& cup, double wavelength_nm) {
  Cup alone = cup;
  alone.position.setZero();
  alone.yaw = 0.0;
  if (auto* mesh = std::get_if<MeshCup>(&alone.shape))
    for (GltfPart& part : mesh->parts) part.transform(mesh->world_from_mesh.inverse());
  GltfModel model(wavelength_nm);
  model.add(cup_name(cup), wall_pieces(alone));
  return model.bytes();
}

}  // namespace fathom
