// The two ends of every light path: from the camera to the first diffuse point, and from there to the projector. Both
// modes of capture and the truth are made of these two functions.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "sim/render/intersect.h"

namespace fathom {

/// The first diffuse point on a camera ray, through a liquid's surface where there is one.
struct SeenPoint {
  Eigen::Vector3d point;   ///< [m] world
  Eigen::Vector3d normal;  ///< unit, towards the camera's side
  double albedo;
  int object;
  const LiquidSurface* liquid;  ///< the liquid the point lies under, or nullptr
  double transmittance;         ///< of radiance on the way to the camera: Fresnel, 1/n², Beer–Lambert
};

/// How the projector lights a point.
struct Illumination {
  Eigen::Vector3d direction;  ///< unit, world: in which the light left the projector
  double irradiance;          ///< [1/m²] on the surface per unit radiant intensity of the projector in that direction
};

std::optional<SeenPoint> see(const Intersector& world, const Ray& camera_ray);

/// Nothing when the projector does not reach the point.
std::optional<Illumination> illuminate(const Intersector& world, const Eigen::Vector3d& projector,
                                       const SeenPoint& seen);

}  // namespace fathom
