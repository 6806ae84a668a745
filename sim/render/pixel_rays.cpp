#include "sim/render/pixel_rays.h"

namespace fathom {
namespace {

/// Where light bends that leaves the source in a direction and crosses so many interfaces.
std::vector<Eigen::Vector3d> bends_on_way(const Intersector& world, const Source& source,
                                          const Eigen::Vector3d& direction, int crossings) {
  std::vector<Eigen::Vector3d> bends;
  Flight flight{ray_differential_from(source.position, direction), source.inside, 1.0};
  for (int i = 0; i < crossings; ++i) {
    const std::optional<Crossing> next =
        next_crossing(world, {flight.differential.origin, flight.differential.direction}, flight.inside);
    if (!next) break;
    pass(world, *next, Event::refract, flight);
    bends.push_back(next->hit.point);
  }
  return bends;
}

}  // namespace

std::optional<PixelRays> rays_of_pixel(const PointLight& projector, const Rig& rig, double x_px, double y_px) {
  std::vector<Eigen::Vector3d> camera_bends;
  const auto seen =
      see(projector.world(), {rig.camera_in_world(), rig.direction_in_world(x_px, y_px)}, 0, &camera_bends);
  if (!seen) return std::nullopt;
  PixelRays rays{*seen, std::move(camera_bends), illuminate(projector, *seen), {}};
  if (rays.light)
    rays.projector_bends =
        bends_on_way(projector.world(), projector.source(), rays.light->direction, rays.light->crossings);
  return rays;
}

}  // namespace fathom
