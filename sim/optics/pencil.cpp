#include "sim/optics/pencil.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace fathom {

Matrix32d perpendicular_to(const Eigen::Vector3d& direction) {
  Matrix32d basis;
  basis.col(0) = direction.unitOrthogonal();
  basis.col(1) = direction.cross(basis.col(0));
  return basis;
}

Pencil pencil_from(const Eigen::Vector3d& point, const Eigen::Vector3d& direction) {
  return {point, direction, Matrix32d::Zero(), perpendicular_to(direction)};
}

void advance(Pencil& pencil, const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
  const double distance = (point - pencil.origin).dot(pencil.direction);
  const Matrix32d at_distance = pencil.d_origin + distance * pencil.d_direction;
  pencil.d_origin = at_distance - pencil.direction * (normal.transpose() * at_distance) / normal.dot(pencil.direction);
  pencil.origin = point;
}

bool refract(Pencil& pencil, const SurfaceFrame& surface, double n_from, double n_to) {
  const Eigen::Vector3d& normal = surface.normal;
  const double eta = n_from / n_to;
  const double cos_from = -pencil.direction.dot(normal);
  const double cos_to_squared = 1.0 - eta * eta * (1.0 - cos_from * cos_from);
  if (cos_to_squared <= 0.0) return false;
  const double cos_to = std::sqrt(cos_to_squared);
  const double along_normal = eta * cos_from - cos_to;
  const Matrix32d d_normal = surface.curvature * pencil.d_origin;
  const Eigen::RowVector2d d_cos_from =
      -(normal.transpose() * pencil.d_direction + pencil.direction.transpose() * d_normal);
  const Eigen::RowVector2d d_along_normal = (eta - eta * eta * cos_from / cos_to) * d_cos_from;
  pencil.direction = eta * pencil.direction + along_normal * normal;
  pencil.d_direction = eta * pencil.d_direction + along_normal * d_normal + normal * d_along_normal;
  return true;
}

void reflect(Pencil& pencil, const SurfaceFrame& surface) {
  const Eigen::Vector3d& normal = surface.normal;
  const double cos_from = -pencil.direction.dot(normal);
  const Matrix32d d_normal = surface.curvature * pencil.d_origin;
  const Eigen::RowVector2d d_cos_from =
      -(normal.transpose() * pencil.d_direction + pencil.direction.transpose() * d_normal);
  pencil.direction += 2.0 * cos_from * normal;
  pencil.d_direction += 2.0 * (normal * d_cos_from + cos_from * d_normal);
}

Landing land(const Pencil& pencil, const Eigen::Vector3d& target) {
  const Matrix32d basis = perpendicular_to(pencil.direction);
  const Eigen::Vector3d offset = target - pencil.origin;
  const double distance = offset.dot(pencil.direction);
  return {distance, basis.transpose() * offset, basis.transpose() * (pencil.d_origin + distance * pencil.d_direction)};
}

}  // namespace fathom
