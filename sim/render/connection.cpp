#include "sim/render/connection.h"

#include <algorithm>
#include <variant>

#include "sim/optics/fresnel.h"
#include "sim/optics/medium.h"
#include "sim/optics/snell.h"

namespace fathom {
namespace {

/// Follows a ray from the first surface that it hits.
std::optional<SeenPoint> follow(const Intersector& world, Ray ray, std::optional<Hit> hit, BodySet inside) {
  const double n_camera = index_of(medium_in(world.geometry(), inside));
  double through = 1.0;
  bool refracted = false;
  for (int crossings = 0; hit && crossings < kMostCrossings; hit = world.first_hit(ray)) {
    const Body* medium = medium_in(world.geometry(), inside);
    const double n_from = index_of(medium);
    if (medium) through *= transmittance(medium->extinction(), hit->distance);
    if (const auto* diffuse = std::get_if<Diffuse>(&hit->surface->optics)) {
      through *= n_camera * n_camera / (n_from * n_from);
      return SeenPoint{hit->point, hit->normal, diffuse->albedo, hit->surface->object, inside,
                       medium,     refracted,   through,         ray.direction};
    }
    const BodySet after = beyond(*hit, inside);
    const Body* next = medium_in(world.geometry(), after);
    ray.origin = hit->point;
    if (next == medium) {
      inside = after;
      continue;
    }
    const auto bent = refract(ray.direction, hit->normal, n_from, index_of(next));
    if (bent && next && next->scatters()) {
      through *= n_camera * n_camera / (n_from * n_from);
      return SeenPoint{hit->point,
                       hit->normal,
                       next->surface_albedo,
                       hit->surface->object,
                       inside,
                       medium,
                       refracted,
                       through,
                       ray.direction,
                       next,
                       after};
    }
    ++crossings;
    if (bent) {
      const double cosine = std::min(-ray.direction.dot(hit->normal), 1.0);
      through *= 1.0 - fresnel_reflectance(cosine, n_from, index_of(next));
      ray.direction = *bent;
      inside = after;
      refracted = true;
    } else {
      ray.direction = reflect(ray.direction, hit->normal);
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<SeenPoint> see(const Intersector& world, const Ray& camera_ray, BodySet inside) {
  return follow(world, camera_ray, world.first_hit(camera_ray), inside);
}

Packet<SeenPoint> see(const Intersector& world, std::span<const Ray> camera_rays) {
  const Packet<Hit> hits = world.first_hits(camera_rays);
  Packet<SeenPoint> seen;
  for (std::size_t i = 0; i < camera_rays.size(); ++i)
    if (const Hit* hit = hits.find(i))
      if (const auto point = follow(world, camera_rays[i], *hit, 0)) seen.set(i, *point);
  return seen;
}

bool takes_up(const SeenPoint& seen, const Eigen::Vector3d& arrival) {
  return !seen.entered || refract(arrival, seen.normal, index_of(seen.around), seen.entered->medium.n);
}

std::optional<Illumination> illuminate(const PointLight& projector, const SeenPoint& seen) {
  Packet<SeenPoint> alone;
  alone.set(0, seen);
  const Packet<Illumination> lights = illuminate(projector, alone);
  const Illumination* light = lights.find(0);
  return light ? std::optional(*light) : std::nullopt;
}

Packet<Illumination> illuminate(const PointLight& projector, const Packet<SeenPoint>& seen) {
  Packet<Illumination> strongest;
  for_each_illumination(projector, seen, [&](std::size_t i, const Illumination& light) {
    if (light.through_scattering) return;
    const Illumination* other = strongest.find(i);
    if (!other || light.irradiance > other->irradiance) strongest.set(i, light);
  });
  return strongest;
}

}  // namespace fathom
