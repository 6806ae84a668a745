// The whole scene as the space of a walk (see random_walk.h): air, clear bodies, bodies that scatter, diffuse surfaces.
// A walker's region is the set of bodies that it is in.
#pragma once

#include "sim/optics/glazed_wall.h"
#include "sim/optics/interface.h"
#include "sim/render/crossing.h"

namespace fathom {

class WorldSpace {
 public:
  /// Keeps a reference to `world`, which must outlive it.
  explicit WorldSpace(const Intersector& world) : world_(world) {}

  struct Boundary {
    double distance;         ///< [m]
    std::optional<Hit> hit;  ///< without one: the level surface of a liquid, or nothing at all
    bool level;
  };

  /// The first scattering is the medium's own; for all others its forward peak is left out.
  const Turbid& medium(const Walker& walker) const;
  Boundary next_boundary(const Walker& walker, double reach) const;

  /// Besides what random_walk() tells it, the visitor is told `at_wall(walker, normal, albedo)` or
  /// `at_glazed_wall(walker, normal, glaze)`. Ends a walk that has left the scene or slipped out between two triangles.
  template <class Visitor>
  bool meet(const Boundary& boundary, Walker& walker, Rng& rng, Visitor& visitor) const {
    if (boundary.level) {
      const Body* liquid = medium_in(world_.geometry(), walker.region);
      if (cross_interface(walker, -Eigen::Vector3d::UnitZ(), liquid->medium.n, 1.0, rng)) walker.region = 0;
      return true;
    }
    if (!boundary.hit) return false;
    const Hit& hit = *boundary.hit;
    if (const auto* wall = std::get_if<Diffuse>(&hit.surface->optics)) {
      bounce_off_wall(walker, hit.normal, wall->albedo, rng, visitor);
      return true;
    }
    if (const auto* glazed = std::get_if<Glazed>(&hit.surface->optics)) {
      const Glaze& glaze = glaze_under(world_.geometry(), *glazed, medium_in(world_.geometry(), walker.region));
      visitor.at_glazed_wall(walker, hit.normal, glaze);
      return bounce_off_glaze(walker, hit.normal, glaze, rng);
    }
    const BodySet after = beyond(hit, walker.region);
    const Body *from = medium_in(world_.geometry(), walker.region), *to = medium_in(world_.geometry(), after);
    if (from == to || cross_interface(walker, hit.normal, index_of(from), index_of(to), rng)) walker.region = after;
    return true;
  }

 private:
  const Intersector& world_;
};

}  // namespace fathom
