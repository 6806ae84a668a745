#include "sim/scene/geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

#include "core/error.h"
#include "core/input_policy.h"
#include "sim/scene/cup.h"
#include "sim/scene/cup_mesh.h"
#include "sim/scene/wetted_wall.h"

namespace fathom {
namespace {

/// Collects surfaces and bodies; bodies get their final numbers at the end, when all priorities are known.
class Builder {
 public:
  Builder(Geometry& geometry, double wavelength_nm) : geometry_(geometry), wavelength_nm_(wavelength_nm) {}

  void add_desk(const Desk& desk) {
    const Pose place(Eigen::Translation3d(desk.centre.x(), desk.centre.y(), 0.0));
    add_opaque(desk_part(desk), new_object("desk", place));
  }

  void add_cup(const Cup& cup, std::size_t index, bool on_desk) {
    const std::string prefix = fmt::format("cup {} ", index);
    const int object = new_object(prefix + cup_name(cup), world_from_cup(cup));
    const std::optional<int> liquid = cup.filling ? std::optional(add_filling(cup, prefix)) : std::nullopt;
    geometry_.cups.push_back({object, liquid ? std::optional(bodies_[*liquid].body.object) : std::nullopt});
    const auto* shape = std::get_if<CupShape>(&cup.shape);
    const auto* mesh = std::get_if<MeshCup>(&cup.shape);
    if (shape && shape->material)
      add_clear_wall(cup, *shape, object, on_desk);
    else if (mesh && liquid)
      add_parts(cup_parts(cup), object, on_desk, Contents{*mesh->cavity, *liquid});
    else
      add_parts(cup_parts(cup), object, on_desk);
  }

  void add_object(const Object& object, std::size_t index, bool on_desk) {
    const int number = new_object(fmt::format("object {} {}", index, object_name(object)), object.world_from_object);
    geometry_.things.push_back(number);
    add_parts(object_parts(object), number, on_desk);
  }

  /// A scene of many things that are small enough by themselves may be too large.
  void require_room() {
    for (; counted_ < geometry_.surfaces.size(); ++counted_) {
      const Mesh& mesh = geometry_.surfaces[counted_].mesh;
      claimed_ += traced_bytes(mesh.vertices.size(), mesh.triangles.size());
    }
    require_within_limit("the scene", "", claimed_, "triangles");
  }

  /// Numbers the bodies by rising priority.
  void finish() {
    constexpr std::size_t kMostBodies = 8 * sizeof(BodySet);
    if (bodies_.size() > kMostBodies)
      throw Error("the scene",
                  fmt::format("has {} bodies that light enters, must be at most {}", bodies_.size(), kMostBodies));
    std::vector<int> order(bodies_.size()), rank(bodies_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return key(bodies_[a]) < key(bodies_[b]); });
    for (std::size_t i = 0; i < order.size(); ++i) {
      rank[order[i]] = static_cast<int>(i);
      geometry_.bodies.push_back(bodies_[order[i]].body);
    }
    for (Surface& surface : geometry_.surfaces)
      if (auto* interface = std::get_if<Interface>(&surface.optics)) {
        interface->body = rank[interface->body];
        if (interface->liquid) interface->liquid = rank[*interface->liquid];
      }
    forget_plain_where_bodies_meet();
    glaze_surfaces();
  }

 private:
  int new_object(std::string name, const Pose& world_from_object) {
    geometry_.objects.push_back(std::move(name));
    geometry_.world_from_object.push_back(world_from_object);
    return static_cast<int>(geometry_.objects.size());
  }

  enum class Priority { liquid, gltf, wall };
  struct RankedBody {
    Body body;
    Priority priority;
  };

  /// Among glTF bodies the denser one wins: glass over the liquid in it.
  static std::pair<Priority, double> key(const RankedBody& ranked) {
    return {ranked.priority, ranked.priority == Priority::gltf ? ranked.body.medium.n : 0.0};
  }

  /// A level liquid that may share its place with another body, as in a cup that stands in a bowl, has more than its
  /// own surface in the light's way.
  void forget_plain_where_bodies_meet() {
    std::vector<Eigen::AlignedBox2d> boxes(geometry_.bodies.size());
    std::vector<double> radii(boxes.size());  // of circles about the boxes' centres
    for_each_corner([&](int body, const Eigen::Vector2d& corner) { boxes[body].extend(corner); });
    for_each_corner([&](int body, const Eigen::Vector2d& corner) {
      radii[body] = std::max(radii[body], (corner - boxes[body].center()).norm());
    });
    for (std::size_t a = 0; a < boxes.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        if ((boxes[a].center() - boxes[b].center()).norm() < radii[a] + radii[b])
          geometry_.bodies[a].plain = geometry_.bodies[b].plain = false;
  }

  /// Calls `visit` with the body and the x and y of every vertex of the bodies' boundaries.
  template <class Visit>
  void for_each_corner(Visit visit) const {
    for (const Surface& surface : geometry_.surfaces)
      if (const auto* interface = std::get_if<Interface>(&surface.optics))
        for (const Eigen::Vector3d& vertex : surface.mesh.vertices) visit(interface->body, vertex.head<2>());
  }

  int add_body(int object, const Medium& medium, Priority priority) {
    const Turbid at_wavelength{medium.n(wavelength_nm_), medium.absorption, medium.scattering, medium.anisotropy};
    bodies_.push_back({{object, at_wavelength}, priority});
    if (medium.scatters()) {
      bodies_.back().body.surface_albedo = diffuse_reflectance(medium, at_wavelength.n);
      geometry_.approximations.push_back(fmt::format(
          "{}: scatters; light enters it but in captures of direct light, where it is an opaque diffuse surface of "
          "albedo {:.3f}",
          medium.name, bodies_.back().body.surface_albedo));
    }
    return static_cast<int>(bodies_.size()) - 1;
  }

  void add_opaque(GltfPart part, int object) {
    Surface surface{object, std::move(part.mesh), Diffuse{part.albedo}};
    if (part.coat) {
      surface.optics = Glazed{};
      if (!part.normals.empty()) surface.shape = VertexNormals{std::move(part.normals)};
      coats_.push_back({geometry_.surfaces.size(), part.albedo, *part.coat});
    }
    geometry_.surfaces.push_back(std::move(surface));
  }

  /// Glazes know what media are in front of them, once all bodies have their numbers.
  void glaze_surfaces() {
    std::map<std::array<double, 4>, Glaze> glazes;
    for (const auto& [surface, albedo, coat] : coats_) {
      std::vector<double> outside{1.0};
      for (const Body& body : geometry_.bodies) outside.push_back(body.medium.n);
      std::vector<Glaze>& under = std::get<Glazed>(geometry_.surfaces[surface].optics).under;
      for (const double n : outside)
        under.push_back(
            glazes.try_emplace({albedo, coat.roughness, n, coat.index}, albedo, coat.roughness, n, coat.index)
                .first->second);
    }
  }

  /// The liquid in a clear cup from a mesh.
  struct Contents {
    const Cavity& cavity;
    int body;
  };

  void add_parts(std::vector<GltfPart> parts, int object, bool on_desk, std::optional<Contents> contents = {}) {
    std::map<int, int> body_of_part;
    for (GltfPart& part : parts) {
      if (!part.medium) {
        add_opaque(std::move(part), object);
        continue;
      }
      const auto [known, is_new] = body_of_part.try_emplace(part.body);
      if (is_new) known->second = add_body(object, *part.medium, Priority::gltf);
      if (on_desk) sink(part.mesh);
      if (!contents) {
        add_clear_part(std::move(part), object, {known->second});
        continue;
      }
      auto [dry, wetted] = cut_at_liquid(part, contents->cavity, *bodies_[contents->body].body.level);
      add_clear_part(std::move(dry), object, {known->second, contents->body, false});
      add_clear_part(std::move(wetted), object, {known->second, contents->body, true});
    }
  }

  void add_clear_part(GltfPart part, int object, const Interface& interface) {
    if (part.mesh.triangles.empty()) return;
    Surface surface{object, std::move(part.mesh), interface};
    if (!part.normals.empty()) surface.shape = VertexNormals{std::move(part.normals)};
    geometry_.surfaces.push_back(std::move(surface));
  }

  /// A clear body on the desk reaches so far [m] into it, so that the two share no face.
  static constexpr double kSink = 1e-4;

  static void sink(Mesh& mesh) {
    constexpr double kOnDesk = 1e-5;  // [m] what is nearer may be passed over by a ray that starts on either
    for (Eigen::Vector3d& vertex : mesh.vertices)
      if (std::fabs(vertex.z()) < kOnDesk) vertex.z() = -kSink;
  }

  void add_clear_wall(const Cup& cup, const CupShape& shape, int object, bool on_desk) {
    const int body = add_body(object, *shape.material, Priority::wall);
    for (WallPart& part : wall_parts(shape, on_desk ? kSink : 0.0)) {
      part.mesh.transform(world_from_shape(cup));
      Surface surface{object, std::move(part.mesh), Interface{body}};
      if (part.cone) surface.shape = Cone{cup.position, part.cone->x(), part.cone->y()};
      geometry_.surfaces.push_back(std::move(surface));
    }
  }

  /// Returns the liquid's body.
  int add_filling(const Cup& cup, const std::string& prefix) {
    const Filling& filling = *cup.filling;
    const int object = new_object(prefix + filling.medium.name, world_from_cup(cup));
    const auto* shape = std::get_if<CupShape>(&cup.shape);
    const bool in_clear_wall = is_clear(cup), plain = filling.form.level() && !in_clear_wall;
    const double level = liquid_level(cup);
    std::optional<LiquidTop> top;
    if (shape && !plain) top.emplace(*shape, level, filling.form);
    Mesh mesh = top ? top->mesh(*shape) : liquid_surface(cup);
    Mesh shell = top && in_clear_wall ? liquid_shell(*shape, *top, mesh) : Mesh{};
    // A curved top knows its directions in the world, so it is moved but not turned with the cup.
    if (top)
      for (Mesh* part : {&mesh, &shell})
        part->transform(Pose(Eigen::Translation3d(cup.position.x(), cup.position.y(), 0.0)));
    const int body = add_body(object, filling.medium, Priority::liquid);
    bodies_[body].body.level = level;
    bodies_[body].body.plain = plain;
    if (plain && shape) bodies_[body].body.vessel = Vessel{cup.position, shape->inner};
    Surface surface{object, std::move(mesh), Interface{body}};
    if (top) {
      top->move(cup.position);
      surface.shape = std::move(*top);
    }
    geometry_.surfaces.push_back(std::move(surface));
    if (!shell.triangles.empty()) geometry_.surfaces.push_back({object, std::move(shell), Interface{body}});
    return body;
  }

  Geometry& geometry_;
  double wavelength_nm_;
  std::vector<RankedBody> bodies_;
  struct CoatedSurface {
    std::size_t surface;  ///< index into Geometry::surfaces
    double albedo;
    Coat coat;
  };
  std::vector<CoatedSurface> coats_;
  std::size_t counted_ = 0;    ///< surfaces, by require_room()
  std::uint64_t claimed_ = 0;  ///< [bytes] by them
};

}  // namespace

double Vessel::clearance(const Eigen::Vector3d& point) const {
  const Eigen::Vector2d at((point.head<2>() - axis).norm(), point.z());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const Eigen::Vector2d piece = profile[i] - profile[i - 1], from = at - profile[i - 1];
    const double share = std::clamp(from.dot(piece) / piece.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (from - share * piece).squaredNorm());
  }
  const double distance = std::sqrt(least), radius = at.x() + distance;
  return distance - radius * (1.0 - std::cos(std::numbers::pi / kFacetsAround));  // less the facets' sagitta
}

Geometry build_geometry(const Scene& scene, double wavelength_nm) {
  Geometry geometry;
  Builder builder(geometry, wavelength_nm);
  if (scene.desk) builder.add_desk(*scene.desk);
  for (std::size_t i = 0; i < scene.cups.size(); ++i) {
    builder.add_cup(scene.cups[i], i, scene.desk.has_value());
    builder.require_room();
  }
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    builder.add_object(scene.objects[i], i, scene.desk.has_value());
    builder.require_room();
  }
  builder.finish();
  return geometry;
}

}  // namespace fathom
