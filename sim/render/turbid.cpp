#include "sim/render/turbid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sim/optics/interface.h"
#include "sim/optics/random_walk.h"
#include "sim/render/crossing.h"

namespace fathom {
namespace {

/// The space of a walk in one body (see random_walk.h), between its boundary and opaque surfaces.
class BodySpace {
 public:
  BodySpace(const Intersector& world, const Body& body) : world_(world), body_(body) {}

  struct Boundary {
    double distance;         ///< [m]
    std::optional<Hit> hit;  ///< without one: the level surface of a liquid, or nothing
    bool level;
  };

  const Turbid& medium(int) const { return body_.medium; }

  Boundary next_boundary(const Walker& walker) const {
    const Ray ray{walker.position, walker.direction};
    if (!body_.plain) {
      std::optional<Hit> hit = world_.first_hit(ray);
      const double distance = hit ? hit->distance : 0.0;
      return {distance, std::move(hit), false};
    }
    // A level surface is met exactly, however near it the flight begins.
    const double rise = *body_.level - walker.position.z();
    const double to_level = walker.direction.z() > 0.0 ? std::max(rise, 0.0) / walker.direction.z()
                                                       : std::numeric_limits<double>::infinity();
    std::optional<Hit> hit = world_.first_opaque(ray);
    if (hit && hit->distance < to_level) return {hit->distance, hit, false};
    return std::isfinite(to_level) ? Boundary{to_level, std::nullopt, true} : Boundary{0.0, std::nullopt, false};
  }

  /// Ends a walk that has slipped out between two triangles.
  template <class Visitor>
  bool meet(const Boundary& boundary, Walker& walker, Rng& rng, Visitor& visitor) const {
    if (boundary.level) {
      leave_through(walker, -Eigen::Vector3d::UnitZ(), body_.medium.n, 1.0, visitor);
      return true;
    }
    if (!boundary.hit) return false;
    const Hit& hit = *boundary.hit;
    if (const auto* interface = std::get_if<Interface>(&hit.surface->optics)) {
      const Body& other = world_.geometry().bodies[interface->body];
      leave_through(walker, hit.normal, body_.medium.n, hit.entering ? other.medium.n : 1.0, visitor);
      return true;
    }
    bounce_off_wall(walker, hit.normal, std::get<Diffuse>(hit.surface->optics).albedo, rng, visitor);
    return true;
  }

 private:
  const Intersector& world_;
  const Body& body_;
};

/// Joins the walk's vertices to the projector.
class Connector {
 public:
  Connector(const PointLight& projector, const Body& body, double transmittance, Rng& rng,
            const std::function<void(const ReturnedLight&)>& visit)
      : projector_(projector), body_(body), transmittance_(transmittance), rng_(rng), visit_(visit) {}

  void at_scattering(const Walker& walker) {
    const double chance = worth(walker.position);
    if (chance < 1.0 && rng_.uniform() >= chance) return;
    const double factor = std::numbers::pi * transmittance_ * walker.weight / chance;
    projector_.connect({walker.position, &body_}, [&](const Connection& way) {
      // Seen from the light: it arrives and is sent towards where the walk came from.
      const double phase = henyey_greenstein(-way.arrival.dot(walker.direction), body_.medium.anisotropy);
      visit_({way.direction, factor * phase * way.spreading * way.transmittance});
    });
  }

  void at_wall(const Walker& walker, const Eigen::Vector3d& normal, double albedo) {
    const double chance = worth(walker.position);
    if (chance < 1.0 && rng_.uniform() >= chance) return;
    const double factor = albedo * transmittance_ * walker.weight / chance;
    projector_.connect({walker.position, &body_, &normal}, [&](const Connection& way) {
      visit_({way.direction, -factor * normal.dot(way.arrival) * way.spreading * way.transmittance});
    });
  }

  void leaves(const Walker&, const Eigen::Vector3d&, double) {}

 private:
  /// Chance with which a place is joined to the projector: deep in a turbid liquid next to no light arrives
  /// unscattered.
  double worth(const Eigen::Vector3d& point) const {
    constexpr double kFaint = 0.01;
    if (!body_.plain) return 1.0;
    const double least_path = std::max(*body_.level - point.z(), 0.0);
    return std::clamp(transmittance(body_.extinction(), least_path) / kFaint, 1e-30, 1.0);
  }

  const PointLight& projector_;
  const Body& body_;
  double transmittance_;
  Rng& rng_;
  const std::function<void(const ReturnedLight&)>& visit_;
};

}  // namespace

void walk_turbid(const PointLight& projector, const SeenPoint& entry, const Eigen::Vector3d& arriving, Rng& rng,
                 const std::function<void(const ReturnedLight&)>& visit) {
  const Body& body = *entry.entered;
  const double n_from = index_of(entry.around), n = body.medium.n;
  const std::optional<Eigen::Vector3d> inside = refract(arriving, entry.normal, n_from, n);
  if (!inside) return;
  const double reflected = fresnel_reflectance(std::min(-arriving.dot(entry.normal), 1.0), n_from, n);
  const double transmittance = entry.transmittance * (1.0 - reflected) * n_from * n_from / (n * n);
  Connector connector(projector, body, transmittance, rng, visit);
  random_walk_of_beam(BodySpace(projector.world(), body), Walker{entry.point, *inside}, rng, connector);
}

}  // namespace fathom
