#include "sim/render/connection.h"

#include <algorithm>
#include <variant>
#include <vector>

#include "sim/optics/fresnel.h"
#include "sim/optics/medium.h"
#include "sim/optics/snell.h"

namespace fathom {
namespace {

/// A camera's ray on its way.
struct Sight {
  Ray ray;
  BodySet inside;
  double n_camera;       ///< refractive index around the camera
  double through = 1.0;  ///< of radiance over n², from the ray's origin to the camera
  bool refracted = false;
  int crossings = 0;
};

Sight sight_of(const Intersector& world, const Ray& camera_ray, BodySet inside) {
  return {camera_ray, inside, index_of(medium_in(world.geometry(), inside))};
}

/// What is seen where a ray ends on an opaque surface; nothing on an interface, which it may cross.
inline std::optional<SeenPoint> seen_on_wall(const Geometry& geometry, const Sight& sight, const Hit& hit) {
  if (std::holds_alternative<Interface>(hit.surface->optics)) return std::nullopt;
  const Body* medium = medium_in(geometry, sight.inside);
  const double n = index_of(medium);
  double through = sight.through;
  if (medium) through *= transmittance(extinction_of(medium), hit.distance);
  through *= sight.n_camera * sight.n_camera / (n * n);
  SeenPoint seen{hit.point, hit.normal,      0.0,     hit.surface->object, sight.inside,
                 medium,    sight.refracted, through, sight.ray.direction};
  if (const auto* glazed = std::get_if<Glazed>(&hit.surface->optics)) {
    seen.glaze = &glaze_under(geometry, *glazed, medium);
    seen.albedo = seen.glaze->albedo(std::min(-sight.ray.direction.dot(hit.normal), 1.0));
  } else {
    seen.albedo = std::get<Diffuse>(hit.surface->optics).albedo;
  }
  return seen;
}

/// Follows a ray on from `hit`. `reflections` gets what is reflected in part on the way and `bends` where it changes
/// its direction, if they are asked for.
std::optional<SeenPoint> follow(const Intersector& world, Sight sight, std::optional<Hit> hit,
                                std::vector<Sight>* reflections = nullptr,
                                std::vector<Eigen::Vector3d>* bends = nullptr) {
  auto& [ray, inside, n_camera, through, refracted, crossings] = sight;
  for (; hit && crossings < kMostCrossings; hit = world.first_hit(ray)) {
    if (const auto seen = seen_on_wall(world.geometry(), sight, *hit)) return seen;
    const Body* medium = medium_in(world.geometry(), inside);
    const double n_from = index_of(medium);
    if (medium) through *= transmittance(extinction_of(medium), hit->distance);
    const BodySet after = beyond(*hit, inside);
    const Body* next = medium_in(world.geometry(), after);
    ray.origin = hit->point;
    if (next == medium) {
      inside = after;
      continue;
    }
    ++crossings;
    const auto bent = refract(ray.direction, hit->normal, n_from, index_of(next));
    if (!bent) {
      if (bends) bends->push_back(hit->point);
      ray.direction = reflect(ray.direction, hit->normal);
      continue;
    }
    const double cosine = std::min(-ray.direction.dot(hit->normal), 1.0);
    if (reflections) {
      reflections->push_back(sight);
      reflections->back().ray.direction = reflect(ray.direction, hit->normal);
      reflections->back().through *= fresnel_reflectance(cosine, n_from, index_of(next));
    }
    if (next && next->scatters()) {
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
    through *= 1.0 - fresnel_reflectance(cosine, n_from, index_of(next));
    if (bends) bends->push_back(hit->point);
    ray.direction = *bent;
    inside = after;
    refracted = true;
  }
  return std::nullopt;
}

/// Draws one of the sights by what they let through, which becomes that of all together; their list is emptied. Faint
/// ones are often dropped. Nothing when none is left.
std::optional<Sight> draw_one(std::vector<Sight>& sights, Rng& rng) {
  constexpr double kFaint = 0.01;  // on a camera's ray that sees most of its light elsewhere
  double all = 0.0;
  for (const Sight& sight : sights) all += sight.through;
  double left = rng.uniform() * std::max(all, kFaint);
  std::optional<Sight> drawn;
  for (const Sight& sight : sights) {
    left -= sight.through;
    if (left >= 0.0) continue;
    drawn = sight;
    drawn->through = std::max(all, kFaint);
    break;
  }
  sights.clear();
  return drawn;
}

}  // namespace

std::optional<SeenPoint> see(const Intersector& world, const Ray& camera_ray, BodySet inside,
                             std::vector<Eigen::Vector3d>* bends) {
  return follow(world, sight_of(world, camera_ray, inside), world.first_hit(camera_ray), nullptr, bends);
}

Packet<SeenPoint> see(const Intersector& world, std::span<const Ray> camera_rays, Packet<Hit>* first) {
  const Packet<Hit> hits = world.first_hits(camera_rays);
  if (first) *first = hits;
  Packet<SeenPoint> seen;
  for (std::size_t i = 0; i < camera_rays.size(); ++i)
    if (const Hit* hit = hits.find(i)) {
      const Sight sight{camera_rays[i], 0, 1.0};
      // Most rays end at once; follow() would move so much memory for them that an image took a tenth longer.
      if (const auto at_once = seen_on_wall(world.geometry(), sight, *hit))
        seen.set(i, *at_once);
      else if (const auto later = follow(world, sight, *hit))
        seen.set(i, *later);
    }
  return seen;
}

void see_mirrored(const Intersector& world, const Ray& camera_ray, Rng& rng,
                  const std::function<void(const SeenPoint&)>& visit) {
  std::vector<Sight> reflections;
  const Sight sight = sight_of(world, camera_ray, 0);
  follow(world, sight, world.first_hit(sight.ray), &reflections);
  if (reflections.empty()) return;
  std::optional<Sight> image = reflections.front();
  reflections.erase(reflections.begin());
  for (; image; image = draw_one(reflections, rng))
    if (const auto seen = follow(world, *image, world.first_hit(image->ray), &reflections)) visit(*seen);
}

std::optional<SeenPoint> see_first_mirrored(const Intersector& world, const Ray& camera_ray) {
  std::vector<Sight> reflections;
  const Sight sight = sight_of(world, camera_ray, 0);
  follow(world, sight, world.first_hit(sight.ray), &reflections);
  if (reflections.empty()) return std::nullopt;
  return follow(world, reflections.front(), world.first_hit(reflections.front().ray));
}

std::optional<Illumination> illuminate(const PointLight& projector, const SeenPoint& seen) {
  const Packet<Illumination> lights = illuminate(projector, alone(seen));
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
