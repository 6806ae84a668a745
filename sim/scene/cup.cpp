#include "sim/scene/cup.h"

#include <algorithm>
#include <cassert>

#include "sim/scene/cup_mesh.h"

namespace fathom {
namespace {

const Cavity& cavity(const MeshCup& mesh) {
  assert(mesh.cavity);
  return *mesh.cavity;
}

double depth(const CupShape& shape) { return shape.height() - shape.bottom(); }
double depth(const MeshCup& mesh) { return cavity(mesh).depth(); }

double volume(const CupShape& shape, double depth) { return shape.volume(depth); }
double volume(const MeshCup& mesh, double depth) { return cavity(mesh).volume(cavity(mesh).floor() + depth); }

double depth_of(const CupShape& shape, double wanted) {
  double low = 0.0, high = depth(shape);
  while (high - low > 1e-9) {  // a nanometre
    const double middle = 0.5 * (low + high);
    (shape.volume(middle) < wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}
double depth_of(const MeshCup& mesh, double wanted) { return cavity(mesh).level_of(wanted) - cavity(mesh).floor(); }

double floor_of(const CupShape& shape) { return shape.bottom(); }
double floor_of(const MeshCup& mesh) { return cavity(mesh).floor(); }

}  // namespace

bool MeshCup::operator==(const MeshCup& other) const {
  // The cavity follows from the parts.
  return name == other.name && parts == other.parts && world_from_mesh.matrix() == other.world_from_mesh.matrix() &&
         (cavity == nullptr) == (other.cavity == nullptr);
}

const std::string& cup_name(const Cup& cup) {
  return std::visit([](const auto& shape) -> const std::string& { return shape.name; }, cup.shape);
}

bool is_clear(const Cup& cup) {
  if (const auto* shape = std::get_if<CupShape>(&cup.shape)) return shape->material.has_value();
  const std::vector<GltfPart>& parts = std::get<MeshCup>(cup.shape).parts;
  return std::any_of(parts.begin(), parts.end(), [](const GltfPart& part) { return part.medium.has_value(); });
}

Pose world_from_shape(const Cup& cup) {
  return Eigen::Translation3d(cup.position.x(), cup.position.y(), 0.0) *
         Eigen::AngleAxisd(cup.yaw, Eigen::Vector3d::UnitZ());
}

Pose world_from_cup(const Cup& cup) {
  const auto* mesh = std::get_if<MeshCup>(&cup.shape);
  return mesh ? mesh->world_from_mesh : world_from_shape(cup);
}

std::vector<GltfPart> cup_parts(const Cup& cup) {
  if (const auto* mesh = std::get_if<MeshCup>(&cup.shape)) return mesh->parts;
  const CupShape& shape = std::get<CupShape>(cup.shape);
  std::vector<GltfPart> parts;
  const auto add = [&](Mesh mesh) {
    GltfPart& part = parts.emplace_back();
    part.mesh = std::move(mesh);
    part.mesh.transform(world_from_shape(cup));
    part.albedo = shape.albedo;
    part.coat = shape.glaze;
    if (part.coat) part.normals = vertex_normals(part.mesh);
  };
  if (shape.glaze) {
    for (WallPart& wall : wall_parts(shape, 0.0)) add(std::move(wall.mesh));
    if (shape.handle) add(handle_mesh(shape));
  } else {
    add(cup_mesh(shape));
  }
  return parts;
}

double cup_depth(const Cup& cup) {
  return std::visit([](const auto& shape) { return depth(shape); }, cup.shape);
}

double cup_capacity(const Cup& cup) { return cup_volume(cup, cup_depth(cup)); }

double cup_volume(const Cup& cup, double depth) {
  return std::visit([&](const auto& shape) { return volume(shape, depth); }, cup.shape);
}

double depth_of_volume(const Cup& cup, double wanted) {
  return std::visit([&](const auto& shape) { return depth_of(shape, wanted); }, cup.shape);
}

double liquid_level(const Cup& cup) {
  constexpr double kBelowRim = 1e-5;  // [m] so that rim and liquid share no plane
  const double depth = std::min(cup.filling->depth, cup_depth(cup) - kBelowRim);
  return std::visit([&](const auto& shape) { return floor_of(shape) + depth; }, cup.shape);
}

Mesh liquid_surface(const Cup& cup) {
  const double level = liquid_level(cup);
  if (const auto* mesh = std::get_if<MeshCup>(&cup.shape)) return cavity(*mesh).surface(level);
  Mesh disc = liquid_disc(std::get<CupShape>(cup.shape), level);
  disc.transform(world_from_shape(cup));
  return disc;
}

}  // namespace fathom
