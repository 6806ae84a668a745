#include "sim/optics/ray_differential.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace fathom {

SurfaceFrame surface_frame(const Eigen::Vector3d& normal, const Eigen::Matrix3d& derivative) {
  const double length = normal.norm();
  const Eigen::Vector3d unit = normal / length;
  return {unit, (Eigen::Matrix3d::Identity() - unit * unit.transpose()) * derivative / length};
}

Matrix32d perpendicular_to(const Eigen::Vector3d& direction) {
  Matrix32d basis;
  basis.col(0) = direction.unitOrthogonal();
  basis.col(1) = direction.cross(basis.col(0));
  return basis;
}

RayDifferential ray_differential_from(const Eigen::Vector3d& point, const Eigen::Vector3d& direction) {
  return {point, direction, Matrix32d::Zero(), perpendicular_to(direction)};
}

void advance(RayDifferential& differential, const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
  const double distance = (point - differential.origin).dot(differential.direction);
  const Matrix32d at_distance = differential.d_origin + distance * differential.d_direction;
  differential.d_origin =
      at_distance - differential.direction * (normal.transpose() * at_distance) / normal.dot(differential.direction);
  differential.origin = point;
}

bool refract(RayDifferential& differential, const SurfaceFrame& surface, double n_from, double n_to) {
  const Eigen::Vector3d& normal = surface.normal;
  const double eta = n_from / n_to;
  const double cos_from = -differential.direction.dot(normal);
  const double cos_to_squared = 1.0 - eta * eta * (1.0 - cos_from * cos_from);
  if (cos_to_squared <= 0.0) return false;
  const double cos_to = std::sqrt(cos_to_squared);
  const double along_normal = eta * cos_from - cos_to;
  const Matrix32d d_normal = surface.curvature * differential.d_origin;
  const Eigen::RowVector2d d_cos_from =
      -(normal.transpose() * differential.d_direction + differential.direction.transpose() * d_normal);
  const Eigen::RowVector2d d_along_normal = (eta - eta * eta * cos_from / cos_to) * d_cos_from;
  differential.direction = eta * differential.direction + along_normal * normal;
  differential.d_direction = eta * differential.d_direction + along_normal * d_normal + normal * d_along_normal;
  return true;
}

void reflect(RayDifferential& differential, const SurfaceFrame& surface) {
  const Eigen::Vector3d& normal = surface.normal;
  const double cos_from = -differential.direction.dot(normal);
  const Matrix32d d_normal = surface.curvature * differential.d_origin;
  const Eigen::RowVector2d d_cos_from =
      -(normal.transpose() * differential.d_direction + differential.direction.transpose() * d_normal);
  differential.direction += 2.0 * cos_from * normal;
  differential.d_direction += 2.0 * (normal * d_cos_from + cos_from * d_normal);
}

Landing land(const RayDifferential& differential, const Eigen::Vector3d& target) {
  const Matrix32d basis = perpendicular_to(differential.direction);
  const Eigen::Vector3d offset = target - differential.origin;
  const double distance = offset.dot(differential.direction);
  return {distance, basis.transpose() * offset,
          basis.transpose() * (differential.d_origin + distance * differential.d_direction)};
}

}  // namespace fathom
