#include "sim/scene/scene.h"

#include <array>

#include "sim/scene/cup_mesh.h"

namespace fathom {
namespace {

Mesh mesh_of(const Box& box) {
  Mesh mesh;
  for (const double z : {0.0, 1.0})
    for (const auto& [x, y] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
      mesh.add_vertex(box.size.cwiseProduct(Eigen::Vector3d(x, y, z)));
  constexpr std::array<std::array<int, 4>, 6> kFaces{
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  for (const auto& [a, b, c, d] : kFaces) {
    mesh.add_triangle(a, b, c);
    mesh.add_triangle(a, c, d);
  }
  return mesh;
}

Mesh mesh_of(const Revolved& revolved) { return revolve(revolved.profile, true); }
Mesh mesh_of(const CupShape& shape) { return cup_mesh(shape); }

std::vector<GltfPart> parts_of(const std::filesystem::path& gltf) { return read_gltf(gltf); }
std::vector<GltfPart> parts_of(const Solid& solid) {
  std::vector<GltfPart> parts(1);
  parts[0].mesh = std::visit([](const auto& form) { return mesh_of(form); }, solid.form);
  parts[0].albedo = solid.albedo;
  return parts;
}

}  // namespace

bool Object::operator==(const Object& other) const {
  if (thing.index() != other.thing.index() || world_from_object.matrix() != other.world_from_object.matrix())
    return false;
  if (const auto* solid = std::get_if<Solid>(&thing)) return *solid == std::get<Solid>(other.thing);
  return object_name(*this) == object_name(other) && object_parts(*this) == object_parts(other);
}

GltfPart desk_part(const Desk& desk) {
  GltfPart part;
  for (const auto& [x, y] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
    part.mesh.add_vertex({desk.centre.x() + x * desk.size.x(), desk.centre.y() + y * desk.size.y(), 0.0});
  part.mesh.add_triangle(0, 1, 2);
  part.mesh.add_triangle(0, 2, 3);
  part.albedo = desk.albedo;
  part.coat = desk.glaze;
  return part;
}

std::string object_name(const Object& object) {
  const auto* solid = std::get_if<Solid>(&object.thing);
  return solid ? solid->name : std::get<std::filesystem::path>(object.thing).filename().string();
}

std::vector<GltfPart> object_parts(const Object& object) {
  std::vector<GltfPart> parts = std::visit([](const auto& thing) { return parts_of(thing); }, object.thing);
  for (GltfPart& part : parts) part.transform(object.world_from_object);
  return parts;
}

}  // namespace fathom
