#include "sim/scene/geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "core/error.h"
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

/// Collects surfaces and bodies; bodies get their final numbers at the end, when all priorities are known.
class Builder {
 public:
  Builder(Geometry& geometry, double wavelength_nm) : geometry_(geometry), wavelength_nm_(wavelength_nm) {}

  void add_cup(const Cup& cup, std::size_t index, bool on_desk) {
    const std::string prefix = fmt::format("cup {} ", index);
    const int object = add_object(geometry_, prefix + cup.shape.name);
    if (cup.shape.material) {
      add_clear_wall(cup, object, on_desk);
    } else {
      Mesh mesh = cup_mesh(cup.shape);
      mesh.transform(world_from_cup(cup));
      geometry_.surfaces.push_back({object, std::move(mesh), Diffuse{cup.shape.albedo}});
    }
    if (cup.filling) add_filling(cup, prefix);
  }

  void add_object_file(const Object& placed, std::size_t index) {
    const std::string name = fmt::format("object {} {}", index, placed.gltf.filename().string());
    const int object = add_object(geometry_, name);
    std::map<int, int> body_of_part;
    for (GltfPart& part : read_gltf(placed.gltf)) {
      part.mesh.transform(placed.world_from_object);
      for (Eigen::Vector3d& normal : part.normals) normal = placed.world_from_object.linear() * normal;
      if (!part.medium) {
        geometry_.surfaces.push_back({object, std::move(part.mesh), Diffuse{part.albedo}});
        continue;
      }
      const Medium& medium = *part.medium;
      if (medium.scatters()) {
        geometry_.surfaces.push_back({object, std::move(part.mesh), opaque(medium)});
        continue;
      }
      const auto [known, is_new] = body_of_part.try_emplace(part.body);
      if (is_new) known->second = add_body(object, medium, Priority::gltf);
      Surface surface{object, std::move(part.mesh), Interface{known->second}};
      if (!part.normals.empty()) surface.shape = VertexNormals{std::move(part.normals)};
      geometry_.surfaces.push_back(std::move(surface));
    }
  }

  /// Numbers the bodies by rising priority.
  void finish() {
    constexpr std::size_t kMostBodies = 8 * sizeof(BodySet);
    if (bodies_.size() > kMostBodies)
      throw Error("the scene", fmt::format("has {} clear bodies, must be at most {}", bodies_.size(), kMostBodies));
    std::vector<int> order(bodies_.size()), rank(bodies_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return key(bodies_[a]) < key(bodies_[b]); });
    for (std::size_t i = 0; i < order.size(); ++i) {
      rank[order[i]] = static_cast<int>(i);
      geometry_.bodies.push_back(bodies_[order[i]].body);
    }
    for (Surface& surface : geometry_.surfaces)
      if (auto* interface = std::get_if<Interface>(&surface.optics)) interface->body = rank[interface->body];
  }

 private:
  enum class Priority { liquid, gltf, wall };
  struct RankedBody {
    Body body;
    Priority priority;
  };

  /// Among glTF bodies the denser one wins: glass over the liquid in it.
  static std::pair<Priority, double> key(const RankedBody& ranked) {
    return {ranked.priority, ranked.priority == Priority::gltf ? ranked.body.n : 0.0};
  }

  static Pose world_from_cup(const Cup& cup) {
    return Eigen::Translation3d(cup.position.x(), cup.position.y(), 0.0) *
           Eigen::AngleAxisd(cup.yaw, Eigen::Vector3d::UnitZ());
  }

  int add_body(int object, const Medium& medium, Priority priority) {
    bodies_.push_back({{object, medium.n(wavelength_nm_), medium.absorption}, priority});
    return static_cast<int>(bodies_.size()) - 1;
  }

  Diffuse opaque(const Medium& medium) {
    const double albedo = diffuse_reflectance(medium, medium.n(wavelength_nm_));
    geometry_.approximations.push_back(
        fmt::format("{}: scatters; shown as an opaque diffuse surface of albedo {:.3f}, light does not enter it",
                    medium.name, albedo));
    return {albedo};
  }

  /// A cup on the desk reaches a little into it, so that the two share no face.
  void add_clear_wall(const Cup& cup, int object, bool on_desk) {
    constexpr double kSink = 1e-4;
    const int body = add_body(object, *cup.shape.material, Priority::wall);
    for (WallPart& part : wall_parts(cup.shape, on_desk ? kSink : 0.0)) {
      part.mesh.transform(world_from_cup(cup));
      Surface surface{object, std::move(part.mesh), Interface{body}};
      if (part.cone) surface.shape = Cone{cup.position, part.cone->x(), part.cone->y()};
      geometry_.surfaces.push_back(std::move(surface));
    }
  }

  void add_filling(const Cup& cup, const std::string& prefix) {
    const Filling& filling = *cup.filling;
    const double level = cup.shape.bottom() + filling.depth;
    const int object = add_object(geometry_, prefix + filling.medium.name);
    const bool plain = filling.form.level() && !cup.shape.material;
    std::optional<LiquidTop> top;
    if (!plain) top.emplace(cup.shape, level, filling.form);
    Mesh mesh = top ? top->mesh() : liquid_disc(cup.shape, level);
    Mesh shell = cup.shape.material ? liquid_shell(cup.shape, mesh) : Mesh{};
    // A curved top knows its directions in the world, so it is not turned with the cup.
    const Pose world_from_top =
        top ? Pose(Eigen::Translation3d(cup.position.x(), cup.position.y(), 0.0)) : world_from_cup(cup);
    mesh.transform(world_from_top);
    if (filling.medium.scatters()) {
      mesh.append(shell);
      geometry_.surfaces.push_back({object, std::move(mesh), opaque(filling.medium)});
      return;
    }
    const int body = add_body(object, filling.medium, Priority::liquid);
    bodies_[body].body.level = level;
    bodies_[body].body.plain = plain;
    Surface surface{object, std::move(mesh), Interface{body}};
    if (top) {
      top->move(cup.position);
      surface.shape = std::move(*top);
    }
    geometry_.surfaces.push_back(std::move(surface));
    if (shell.triangles.empty()) return;
    shell.transform(world_from_top);
    geometry_.surfaces.push_back({object, std::move(shell), Interface{body}});
  }

  Geometry& geometry_;
  double wavelength_nm_;
  std::vector<RankedBody> bodies_;
};

}  // namespace

Geometry build_geometry(const Scene& scene, double wavelength_nm) {
  Geometry geometry;
  if (scene.desk) add_desk(*scene.desk, geometry);
  Builder builder(geometry, wavelength_nm);
  for (std::size_t i = 0; i < scene.cups.size(); ++i) builder.add_cup(scene.cups[i], i, scene.desk.has_value());
  for (std::size_t i = 0; i < scene.objects.size(); ++i) builder.add_object_file(scene.objects[i], i);
  builder.finish();
  return geometry;
}

}  // namespace fathom
