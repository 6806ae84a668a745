// A ray together with its neighbours: how its point and direction change with the direction in which it left its source
// (ray differentials: Igehy, SIGGRAPH 1999). The landing of a whole pencil is what a focused or spread spot of light
// is.
#pragma once

#include <Eigen/Core>

namespace fathom {

using Matrix32d = Eigen::Matrix<double, 3, 2>;

/// Derivatives are by two orthonormal angles [rad] about the starting direction, so their area is a solid angle.
struct RayDifferential {
  Eigen::Vector3d origin;     ///< [m]
  Eigen::Vector3d direction;  ///< unit
  Matrix32d d_origin;         ///< [m/rad]
  Matrix32d d_direction;      ///< [1/rad]
};

/// The normal of a smooth surface and how it turns along it.
struct SurfaceFrame {
  Eigen::Vector3d normal;     ///< unit, on the side the light comes from
  Eigen::Matrix3d curvature;  ///< [1/m] d normal = curvature · d point, for d point in the tangent plane
};

/// From a normal of any length and how that changes with the place.
SurfaceFrame surface_frame(const Eigen::Vector3d& normal, const Eigen::Matrix3d& derivative);

/// Two unit vectors that make a right-handed frame with the unit vector `direction`.
Matrix32d perpendicular_to(const Eigen::Vector3d& direction);

/// All rays from one point, about a unit direction; the columns of d_direction are perpendicular_to(direction).
RayDifferential ray_differential_from(const Eigen::Vector3d& point, const Eigen::Vector3d& direction);

/// Moves the origin to the surface at `point` on the ray; neighbours meet the surface's tangent plane.
void advance(RayDifferential& differential, const Eigen::Vector3d& point, const Eigen::Vector3d& normal);

/// Snell's law and its derivative, at a surface that the origin lies on. False, and nothing changed, on total
/// internal reflection.
bool refract(RayDifferential& differential, const SurfaceFrame& surface, double n_from, double n_to);

/// The law of reflection and its derivative.
void reflect(RayDifferential& differential, const SurfaceFrame& surface);

/// Where the pencil lands on the plane through `target` perpendicular to its ray.
struct Landing {
  double distance;           ///< [m] from the origin to the plane
  Eigen::Vector2d miss;      ///< [m] from the landing to the target
  Eigen::Matrix2d jacobian;  ///< [m/rad] of the landing; |det| is area per solid angle at the source
};
Landing land(const RayDifferential& differential, const Eigen::Vector3d& target);

}  // namespace fathom
