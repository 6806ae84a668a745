// The two ends of every light path: from the camera to the first diffuse point, and from there to the projector. Both
// modes of capture and the truth are made of these functions.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "sim/render/light.h"

namespace fathom {

/// The first diffuse point on a camera ray, through clear bodies where they stand in its way; or the place where it
/// enters a body that scatters.
struct SeenPoint {
  Eigen::Vector3d point;   ///< [m] world
  Eigen::Vector3d normal;  ///< unit, towards the camera's side
  double albedo;           ///< of a body that scatters, its surface_albedo
  int object;
  const Body* around;             ///< the medium at the point; nullptr is air
  bool refracted;                 ///< whether the ray bent on its way
  double transmittance;           ///< of radiance on the way to the camera: Fresnel, 1/n², Beer–Lambert
  const Body* entered = nullptr;  ///< the body that scatters, if any
};

/// How the projector lights a point.
struct Illumination {
  Eigen::Vector3d direction;  ///< unit, world: in which the light left the projector
  double irradiance;          ///< [1/m²] on the surface per unit radiant intensity of the projector in that direction
};

/// Follows a ray that starts in the bodies `inside` (none: in air). Where it cannot leave a body it is totally
/// reflected; partial reflections are left out.
std::optional<SeenPoint> see(const Intersector& world, const Ray& camera_ray, BodySet inside = 0);

/// Whether the point takes up light that travels in the direction `arrival`; a body that scatters reflects some
/// totally.
bool takes_up(const SeenPoint& seen, const Eigen::Vector3d& arrival);

/// Calls `visit` with the Illumination of each way in which the projector's light gets to the point.
template <class Visit>
void for_each_illumination(const PointLight& projector, const SeenPoint& seen, Visit&& visit) {
  projector.connect({seen.point, seen.around, &seen.normal}, [&](const Connection& way) {
    if (takes_up(seen, way.arrival))
      visit(Illumination{way.direction, -way.spreading * way.transmittance * seen.normal.dot(way.arrival)});
  });
}

/// The strongest of them; nothing when the projector does not reach the point.
std::optional<Illumination> illuminate(const PointLight& projector, const SeenPoint& seen);

}  // namespace fathom
