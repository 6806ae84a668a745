// Refraction of directions at a smooth interface.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>

namespace fathom {

/// Snell's law, n_from sin θ_from = n_to sin θ_to, as vectors: the refracted unit direction, or nothing on total
/// internal reflection. `direction` [3] is a unit vector that meets the interface, `normal` [3] the unit normal on the
/// side it comes from (direction·normal ≤ 0).
inline std::optional<Eigen::Vector3d> refract(const Eigen::Vector3d& direction, const Eigen::Vector3d& normal,
                                              double n_from, double n_to) {
  const double eta = n_from / n_to;
  const double cos_from = -direction.dot(normal);
  const double cos_to_squared = 1.0 - eta * eta * (1.0 - cos_from * cos_from);
  if (cos_to_squared <= 0.0) return std::nullopt;
  return eta * direction + (eta * cos_from - std::sqrt(cos_to_squared)) * normal;
}

/// Mirror reflection of a unit direction about a unit normal.
inline Eigen::Vector3d reflect(const Eigen::Vector3d& direction, const Eigen::Vector3d& normal) {
  return direction - 2.0 * direction.dot(normal) * normal;
}

}  // namespace fathom
