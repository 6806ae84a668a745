#include "sim/scene/geometry.h"

#include <fmt/format.h>

#include "sim/scene/cup.h"

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

void add_filling(const Cup& cup, const std::string& prefix, double wavelength_nm, Geometry& geometry) {
  const Medium& medium = cup.filling->medium;
  const double level = liquid_level(cup);
  const double n = medium.n(wavelength_nm);
  Mesh mesh = liquid_surface(cup);
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
  const std::string prefix = fmt::format("cup {} ", index);
  const int object = add_object(geometry, prefix + cup_name(cup));
  for (GltfPart& part : cup_parts(cup))
    geometry.surfaces.push_back({object, std::move(part.mesh), Diffuse{part.albedo}});
  if (cup.filling) add_filling(cup, prefix, wavelength_nm, geometry);
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
