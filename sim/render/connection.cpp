#include "sim/render/connection.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "sim/optics/flat_refraction.h"
#include "sim/optics/fresnel.h"
#include "sim/optics/medium.h"
#include "sim/optics/snell.h"

namespace fathom {
namespace {

SeenPoint seen_at(const Hit& hit, const LiquidSurface* liquid, double transmittance_to_camera) {
  return {hit.point,           hit.normal, std::get<Diffuse>(hit.surface->optics).albedo,
          hit.surface->object, liquid,     transmittance_to_camera};
}

/// The path that bends once, at the liquid's level surface: exact root of Snell's law.
std::optional<Illumination> illuminate_through(const Intersector& world, const LiquidSurface& liquid,
                                               const Eigen::Vector3d& projector, const SeenPoint& seen) {
  const double height = projector.z() - liquid.level, depth = liquid.level - seen.point.z();
  if (height <= 0.0 || depth <= 0.0) return std::nullopt;
  const Eigen::Vector2d across = (seen.point - projector).head<2>();
  const double separation = across.norm();
  const FlatCrossing crossing = cross_flat_interface(height, depth, separation, 1.0, liquid.n);
  const double share = separation > 0.0 ? crossing.offset / separation : 0.0;
  const Eigen::Vector3d bend(projector.x() + share * across.x(), projector.y() + share * across.y(), liquid.level);
  const Eigen::Vector3d to_bend = bend - seen.point;
  const double path_in_liquid = to_bend.norm();
  const double cos_surface = seen.normal.dot(to_bend) / path_in_liquid;
  if (cos_surface <= 0.0) return std::nullopt;
  if (world.occluded(seen.point, bend) || world.occluded(bend, projector)) return std::nullopt;
  const Eigen::Vector3d direction = (bend - projector).normalized();
  const double cos_above = std::min(-direction.z(), 1.0);
  const double through =
      (1.0 - fresnel_reflectance(cos_above, 1.0, liquid.n)) * transmittance(liquid.absorption, path_in_liquid);
  return Illumination{direction, flat_spreading(crossing, height, depth, 1.0, liquid.n) * through * cos_surface};
}

}  // namespace

std::optional<SeenPoint> see(const Intersector& world, const Ray& camera_ray) {
  const std::optional<Hit> hit = world.first_hit(camera_ray);
  if (!hit) return std::nullopt;
  const auto* liquid = std::get_if<LiquidSurface>(&hit->surface->optics);
  if (!liquid) return seen_at(*hit, nullptr, 1.0);
  if (camera_ray.direction.z() >= 0.0) return std::nullopt;  // from below, only through an opaque wall
  const std::optional<Eigen::Vector3d> inside = refract(camera_ray.direction, hit->normal, 1.0, liquid->n);
  const std::optional<Hit> below = inside ? world.first_opaque_hit({hit->point, *inside}) : std::nullopt;
  if (!below) return std::nullopt;
  const double cos_above = std::min(-camera_ray.direction.dot(hit->normal), 1.0);
  const double through = (1.0 - fresnel_reflectance(cos_above, 1.0, liquid->n)) / (liquid->n * liquid->n) *
                         transmittance(liquid->absorption, below->distance);
  return seen_at(*below, liquid, through);
}

std::optional<Illumination> illuminate(const Intersector& world, const Eigen::Vector3d& projector,
                                       const SeenPoint& seen) {
  if (seen.liquid) return illuminate_through(world, *seen.liquid, projector, seen);
  const Eigen::Vector3d from_projector = seen.point - projector;
  const double squared = from_projector.squaredNorm();
  const Eigen::Vector3d direction = from_projector / std::sqrt(squared);
  const double cos_surface = -seen.normal.dot(direction);
  if (cos_surface <= 0.0 || world.occluded(seen.point, projector)) return std::nullopt;
  return Illumination{direction, cos_surface / squared};
}

}  // namespace fathom
