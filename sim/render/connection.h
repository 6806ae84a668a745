// The two ends of every light path: from the camera to the first diffuse point, and from there to the projector. Both
// modes of capture and the truth are made of these functions.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/rng.h"
#include "sim/optics/glazed_wall.h"
#include "sim/optics/snell.h"
#include "sim/render/light.h"

namespace fathom {

/// The first diffuse point on a camera ray, through clear bodies where they stand in its way; or the place where it
/// enters a body that scatters.
struct SeenPoint {
  Eigen::Vector3d point;   ///< [m] world
  Eigen::Vector3d normal;  ///< unit, towards the camera's side
  double albedo;           ///< of a body that scatters, its surface_albedo; of a glaze, towards the camera
  int object;
  BodySet inside;                 ///< the bodies around it, on the camera's side
  const Body* around;             ///< the medium there; nullptr is air
  bool refracted;                 ///< whether the ray bent on its way
  double transmittance;           ///< of radiance on the way to the camera: Fresnel, 1/n², Beer–Lambert
  Eigen::Vector3d arriving;       ///< unit, in which the camera's ray gets there
  const Body* entered = nullptr;  ///< the body that scatters, if any
  BodySet beyond = 0;             ///< with it, the bodies on its side
  const Glaze* glaze = nullptr;   ///< of a glazed surface
};

/// How the projector lights a point.
struct Illumination {
  Eigen::Vector3d direction;  ///< unit, world: in which the light left the projector
  double irradiance;          ///< [1/m²] on the surface per unit radiant intensity of the projector in that direction
  double reflectance;         ///< reflectance_factor() of the surface for it
  int crossings;              ///< as in Connection
  bool through_scattering;    ///< as in Connection
};

/// Follows a ray that starts in the bodies `inside` (none: in air). Where it cannot leave a body it is totally
/// reflected; partial reflections are left to see_mirrored(). `bends` gets the points [m] where it bends, if it is
/// asked for.
std::optional<SeenPoint> see(const Intersector& world, const Ray& camera_ray, BodySet inside = 0,
                             std::vector<Eigen::Vector3d>* bends = nullptr);
/// The same for at most kPacket rays in air that lie side by side. `first` gets the surfaces that they meet first, if
/// it is asked for.
Packet<SeenPoint> see(const Intersector& world, std::span<const Ray> camera_rays, Packet<Hit>* first = nullptr);

/// The partial mirror images on a ray in air: calls `visit` with what stands mirrored in the first interface, and for
/// all further reflections, within bodies and of mirror images, with some that stand for them by chance. In a scene
/// that absorbs nothing, transmittance · n² of these and of see() is 1 together, in the mean.
void see_mirrored(const Intersector& world, const Ray& camera_ray, Rng& rng,
                  const std::function<void(const SeenPoint&)>& visit);

/// The first of them.
std::optional<SeenPoint> see_first_mirrored(const Intersector& world, const Ray& camera_ray);

/// Whether the point takes up light that travels in the direction `arrival`; a body that scatters reflects some
/// totally.
inline bool takes_up(const SeenPoint& seen, const Eigen::Vector3d& arrival) {
  return !seen.entered || refract(arrival, seen.normal, index_of(seen.around), seen.entered->medium.n);
}

/// π · BRDF for light that travels in the direction `arrival` and is seen by the camera: a diffuse surface's albedo.
inline double reflectance_factor(const SeenPoint& seen, const Eigen::Vector3d& arrival) {
  return seen.glaze ? reflectance_factor(*seen.glaze, seen.normal, -arrival, -seen.arriving) : seen.albedo;
}

inline Illumination illumination_by(const Connection& way, const SeenPoint& seen) {
  return {way.direction, -way.spreading * way.transmittance * seen.normal.dot(way.arrival),
          reflectance_factor(seen, way.arrival), way.crossings, way.through_scattering};
}

/// Calls `visit(i, illumination)` for each way in which the projector's light gets to the points seen, i their number.
/// `starts`: as for PointLight::connect().
template <class Visit>
void for_each_illumination(const PointLight& projector, const Packet<SeenPoint>& seen, Visit&& visit,
                           const Starts& starts = {}) {
  Packet<Receiver> receivers;
  for (std::size_t i = 0; i < kPacket; ++i)
    if (const SeenPoint* at = seen.find(i)) receivers.set(i, {at->point, at->around, &at->normal});
  projector.connect(
      receivers,
      [&](std::size_t i, const Connection& way) {
        const SeenPoint& at = *seen.find(i);
        if (takes_up(at, way.arrival)) visit(i, illumination_by(way, at));
      },
      starts);
}

/// The strongest of them where bodies that scatter are opaque; nothing where the projector does not reach the point.
Packet<Illumination> illuminate(const PointLight& projector, const Packet<SeenPoint>& seen);
std::optional<Illumination> illuminate(const PointLight& projector, const SeenPoint& seen);

}  // namespace fathom
