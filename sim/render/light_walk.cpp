#include "sim/render/light_walk.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/optics/fresnel.h"
#include "sim/optics/random_walk.h"
#include "sim/optics/snell.h"
#include "sim/render/world_space.h"

namespace fathom {
namespace {

/// Joins the walk's vertices to the projector. A walker's weight is what the camera receives of π · radiance over the
/// square of the refractive index, which interfaces keep.
class Connector {
 public:
  Connector(const PointLight& projector, Rng& rng, const std::function<void(const ReturnedLight&)>& visit)
      : projector_(projector), rng_(rng), visit_(visit) {}

  void at_scattering(const Walker& walker) {
    const Body* body = medium_in(projector_.world().geometry(), walker.region);
    const double chance = worth(*body, walker.position);
    if (chance < 1.0 && rng_.uniform() >= chance) return;
    const double factor = std::numbers::pi * walker.weight / (chance * body->medium.n * body->medium.n);
    connect({walker.position, body}, [&](const Connection& way) {
      // Seen from the light: it arrives and is sent towards where the walk came from.
      const double phase = henyey_greenstein(-way.arrival.dot(walker.direction), body->medium.anisotropy);
      visit_({way.direction, factor * phase * way.spreading * way.transmittance});
    });
  }

  void at_wall(const Walker& walker, const Eigen::Vector3d& normal, double albedo) {
    const Body* body = medium_in(projector_.world().geometry(), walker.region);
    const double chance = body ? worth(*body, walker.position) : 1.0;
    if (chance < 1.0 && rng_.uniform() >= chance) return;
    const double n = index_of(body), factor = albedo * walker.weight / (chance * n * n);
    connect({walker.position, body, &normal}, [&](const Connection& way) {
      visit_({way.direction, -factor * normal.dot(way.arrival) * way.spreading * way.transmittance});
    });
  }

 private:
  template <class Visit>
  void connect(const Receiver& receiver, Visit visit) {
    projector_.connect(receiver, visit);
    projector_.connect_mirrored(receiver, visit);
  }

  /// Chance with which a place is joined to the projector: deep in a turbid liquid next to no light arrives
  /// unscattered.
  static double worth(const Body& body, const Eigen::Vector3d& point) {
    constexpr double kFaint = 0.01;
    if (!body.plain) return 1.0;
    const double least_path = std::max(*body.level - point.z(), 0.0);
    return std::clamp(transmittance(body.extinction(), least_path) / kFaint, 1e-30, 1.0);
  }

  const PointLight& projector_;
  Rng& rng_;
  const std::function<void(const ReturnedLight&)>& visit_;
};

}  // namespace

void walk_light(const PointLight& projector, const SeenPoint& seen, Rng& rng,
                const std::function<void(const ReturnedLight&)>& visit) {
  const double n = index_of(seen.around);
  Walker walker{seen.point, seen.arriving, seen.transmittance * n * n, seen.inside};
  const WorldSpace space(projector.world());
  Connector connector(projector, rng, visit);
  if (!survives(walker, kRouletteShare, rng)) return;
  if (seen.entered) {
    const double n_entered = seen.entered->medium.n;
    const double cosine = std::min(-seen.arriving.dot(seen.normal), 1.0);
    walker.weight *= 1.0 - fresnel_reflectance(cosine, n, n_entered);
    walker.direction = *refract(seen.arriving, seen.normal, n, n_entered);
    walker.region = seen.beyond;
    random_walk_of_beam(space, walker, rng, connector);
  } else {
    walker.weight *= seen.albedo;
    walker.direction = sample_diffuse(seen.normal, rng);
    random_walk(space, walker, kRouletteShare * walker.weight, rng, connector);
  }
}

}  // namespace fathom
