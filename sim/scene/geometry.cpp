#include "sim/scene/geometry.h"

#include <fmt/format.h>

#include "sim/scene/cup_mesh.h"
#include "sim/scene/gltf.h"

namespace fathom {
namespace {

int add_object(Geometry& geometry, std::string name) {
  geometry.objects.push_back(std::move(name));
  return static_cast<int>(geometry.objects.size());
}

void add_desk(const Desk& desk, Geometry& geometry) {
  Mesh mesh;
  for (const auto& [x, y] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
    mesh.add_vertex({desk.centre.x() + x * desk.size.x(), desk.centre.y() + y * desk.size.y(), 0.0});
  mesh.add_triangle(0, 1, 2);
  mesh.add_triangle(0, 2, 3);
  geometry.surfaces.push_back({add_object(geometry, "desk"), std::move(mesh), Diffuse{desk.albedo}});
}

void add_filling(const Cup& cup, const Pose& world_from_cup, const std::string& prefix, double wavelength_nm,
                 Geometry& geometry) {
  const Medium& medium = cup.filling->medium;
  const double level = cup.shape.bottom() + cup.filling->depth;
  const double n = medium.n(wavelength_nm);
  Mesh mesh = liquid_disc(cup.shape, level);
  mesh.transform(world_from_cup);
  const int object = add_object(geometry, prefix + medium.name);
  if (!medium.scatters()) {
    geometry.surfaces.push_back({object, std::move(mesh), LiquidSurface{level, n, medium.absorption}});
    return;
  }
  const double albedo = diffuse_reflectance(medium, n);
  geometry.surfaces.push_back({object, std::move(mesh), Diffuse{albedo}});
  geometry.approximations.push_back(
      fmt::format("{}: scatters; shown as an opaque diffuse surface of albedo {:.3f}, light does not enter it",
                  medium.name, albedo));
}

void add_cup(const Cup& cup, std::size_t index, double wavelength_nm, Geometry& geometry) {
  const Pose world_from_cup = Eigen::Translation3d(cup.position.x(), cup.position.y(), 0.0) *
                              Eigen::AngleAxisd(cup.yaw, Eigen::Vector3d::UnitZ());
  const std::string prefix = fmt::format("cup {} ", index);
  Mesh mesh = cup_mesh(cup.shape);
  mesh.transform(world_from_cup);
  geometry.surfaces.push_back(
      {add_object(geometry, prefix + cup.shape.name), std::move(mesh), Diffuse{cup.shape.albedo}});
  if (cup.filling) add_filling(cup, world_from_cup, prefix, wavelength_nm, geometry);
}

}  // namespace

Geometry build_geometry(const Scene& scene, double wavelength_nm) {
  Geometry geometry;
  if (scene.desk) add_desk(*scene.desk, geometry);
  for (std::size_t i = 0; i < scene.cups.size(); ++i) add_cup(scene.cups[i], i, wavelength_nm, geometry);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const std::string name = fmt::format("object {} {}", i, scene.objects[i].gltf.filename().string());
    const int object = add_object(geometry, name);
    for (GltfPart& part : read_gltf(scene.objects[i].gltf)) {
      part.mesh.transform(scene.objects[i].world_from_object);
      geometry.surfaces.push_back({object, std::move(part.mesh), Diffuse{part.albedo}});
    }
  }
  return geometry;
}

}  // namespace fathom
