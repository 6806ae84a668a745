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
  /// The walk begins at `start`, in the direction `beam` or, where that is zero, in any.
  Connector(const PointLight& projector, const Eigen::Vector3d& start, const Eigen::Vector3d& beam, Rng& rng,
            const std::function<void(const ReturnedLight&)>& visit)
      : projector_(projector), start_(start), beam_(beam), rng_(rng), visit_(visit) {}

  void at_scattering(const Walker& walker) {
    // The walk's own way to its first scattering and the scattering itself are the medium's; the light's way is not.
    const Turbid& medium = space_.medium(walker);
    const double factor = std::numbers::pi * walker.weight / (medium.n * medium.n);
    connect(walker, nullptr, Loss::without_peak, [&](const Connection& way) {
      // Seen from the light: it arrives and is sent towards where the walk came from.
      return factor * phase_function(medium, -way.arrival.dot(walker.direction));
    });
  }

  void at_wall(const Walker& walker, const Eigen::Vector3d& normal, double albedo) {
    at_surface(walker, normal, [&](const Connection&) { return albedo; });
  }

  void at_glazed_wall(const Walker& walker, const Eigen::Vector3d& normal, const Glaze& glaze) {
    at_surface(walker, normal, [&](const Connection& way) {
      return reflectance_factor(glaze, normal, -way.arrival, -walker.direction);
    });
  }

 private:
  /// `reflectance(way)` is π · BRDF.
  template <class Reflectance>
  void at_surface(const Walker& walker, const Eigen::Vector3d& normal, Reflectance reflectance) {
    const double n = space_.medium(walker).n, factor = walker.weight / (n * n);
    connect(walker, &normal, walker.scatterings == 0 ? Loss::all : Loss::without_peak,
            [&](const Connection& way) { return -factor * reflectance(way) * normal.dot(way.arrival); });
  }

  /// Chance with which mirrored light is looked for: it is a few hundredths of all.
  static constexpr double kMirrored = 0.25;

  /// `returned(way)` is the share of a way's light that the camera receives.
  template <class Returned>
  void connect(const Walker& walker, const Eigen::Vector3d* facing, Loss loss, Returned returned) {
    const Receiver receiver{walker.position, medium_in(projector_.world().geometry(), walker.region), facing, loss};
    const double chance = receiver.around ? worth(receiver) : 1.0;
    if (chance < 1.0 && rng_.uniform() >= chance) return;
    projector_.connect(receiver, [&](const Connection& way) { give(way, returned(way) / chance, receiver.point); });
    if (rng_.uniform() >= kMirrored) return;
    projector_.connect_mirrored(receiver, walker.weight, rng_.uniform(), [&](const Connection& way) {
      give(way, returned(way) / (chance * kMirrored), receiver.point);
    });
  }

  void give(const Connection& way, double factor, const Eigen::Vector3d& point) {
    // Where walks end differs by as much as this one went aside, and so do the directions that lead there.
    const Eigen::Vector3d gone = point - start_;
    const double aside = (gone - gone.dot(beam_) * beam_).norm();
    visit_({way.direction, factor * way.spreading * way.transmittance, aside * std::sqrt(way.spreading)});
  }

  /// Chance with which a place is joined to the projector: deep in a turbid liquid next to no light arrives
  /// unscattered.
  double worth(const Receiver& receiver) const {
    constexpr double kFaint = 0.3;  // from 0.1 to 1 the time for a given error differs by a tenth
    const Body& body = *receiver.around;
    if (!body.scatters()) return 1.0;
    const double least = body.plain ? 1e-30 : 0.01;  // light may come from another side than thought
    const double left = transmittance(extinction_of(&body, receiver.loss), depth_in(body, receiver.point));
    return std::clamp(left / kFaint, least, 1.0);
  }

  /// About how far [m] light goes within the body to get to a point.
  double depth_in(const Body& body, const Eigen::Vector3d& point) const {
    if (body.plain) return std::max(*body.level - point.z(), 0.0);
    const Eigen::Vector3d towards = (projector_.position() - point).normalized();
    const std::optional<Hit> out = projector_.world().first_interface({point, towards});
    return out ? out->distance : 0.0;
  }

  const PointLight& projector_;
  const WorldSpace space_{projector_.world()};
  const Eigen::Vector3d start_, beam_;
  Rng& rng_;
  const std::function<void(const ReturnedLight&)>& visit_;
};

}  // namespace

void walk_light(const PointLight& projector, const SeenPoint& seen, Rng& rng,
                const std::function<void(const ReturnedLight&)>& visit, const FirstStep* first, double near) {
  const double n = index_of(seen.around);
  Walker walker{seen.point, seen.arriving, seen.transmittance * n * n, seen.inside};
  const WorldSpace space(projector.world());
  if (!survives(walker, kRouletteShare, rng)) return;
  if (seen.entered) {
    const double n_entered = seen.entered->medium.n;
    const double cosine = std::min(-seen.arriving.dot(seen.normal), 1.0);
    walker.weight *= 1.0 - fresnel_reflectance(cosine, n, n_entered);
    walker.direction = *refract(seen.arriving, seen.normal, n, n_entered);
    walker.region = seen.beyond;
    Connector connector(projector, seen.point, walker.direction, rng, visit);
    random_walk_of_beam(space, walker, rng, connector, first, near);
  } else if (seen.glaze) {
    if (!bounce_off_glaze(walker, seen.normal, *seen.glaze, rng)) return;
    Connector connector(projector, seen.point, walker.direction, rng, visit);  // its lobe may be narrow
    random_walk(space, walker, kRouletteShare * walker.weight, rng, connector);
  } else {
    walker.weight *= seen.albedo;
    walker.direction =
        first ? sample_diffuse(seen.normal, first->cosine, first->azimuth) : sample_diffuse(seen.normal, rng);
    Connector connector(projector, seen.point, Eigen::Vector3d::Zero(), rng, visit);
    random_walk(space, walker, kRouletteShare * walker.weight, rng, connector);
  }
}

}  // namespace fathom
