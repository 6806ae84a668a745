#include "sim/optics/ggx.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "sim/optics/fresnel.h"

namespace fathom {

double ggx_density(const Eigen::Vector3d& normal, double alpha) {
  if (normal.z() <= 0.0) return 0.0;
  // cos⁴θ (1 + tan²θ / α²)² without the division by a small cosine.
  const double stretched = normal.head<2>().squaredNorm() / (alpha * alpha) + normal.z() * normal.z();
  return 1.0 / (std::numbers::pi * alpha * alpha * stretched * stretched);
}

double ggx_lambda(const Eigen::Vector3d& direction, double alpha) {
  const double tangent_squared = direction.head<2>().squaredNorm() / (direction.z() * direction.z());
  return 0.5 * (std::sqrt(1.0 + alpha * alpha * tangent_squared) - 1.0);
}

double ggx_visibility(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double alpha) {
  return 1.0 / (1.0 + ggx_lambda(a, alpha) + ggx_lambda(b, alpha));
}

double ggx_reflection(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double alpha, double n_from,
                      double n_to) {
  assert(alpha >= kSmooth);
  if (from.z() <= 0.0 || to.z() <= 0.0) return 0.0;
  const Eigen::Vector3d half = (from + to).normalized();
  const double fresnel = fresnel_reflectance(std::clamp(from.dot(half), 0.0, 1.0), n_from, n_to);
  return fresnel * ggx_density(half, alpha) * ggx_visibility(from, to, alpha) / (4.0 * from.z() * to.z());
}

Eigen::Vector3d sample_visible_normal(const Eigen::Vector3d& from, double alpha, double u1, double u2) {
  assert(from.z() > 0.0);
  // Stretched, the facets are those of a hemisphere, and what `from` sees of it reflects into a spherical cap.
  const Eigen::Vector3d stretched = Eigen::Vector3d(alpha * from.x(), alpha * from.y(), from.z()).normalized();
  const double azimuth = 2.0 * std::numbers::pi * u1;
  const double z = (1.0 - u2) * (1.0 + stretched.z()) - stretched.z();
  const double radius = std::sqrt(std::max(0.0, 1.0 - z * z));
  const Eigen::Vector3d half = Eigen::Vector3d(radius * std::cos(azimuth), radius * std::sin(azimuth), z) + stretched;
  return Eigen::Vector3d(alpha * half.x(), alpha * half.y(), half.z()).normalized();
}

double visible_normal_pdf(const Eigen::Vector3d& from, const Eigen::Vector3d& normal, double alpha) {
  if (from.z() <= 0.0) return 0.0;
  return std::max(0.0, from.dot(normal)) * ggx_density(normal, alpha) / ((1.0 + ggx_lambda(from, alpha)) * from.z());
}

std::optional<GgxSample> sample_ggx_reflection(const Eigen::Vector3d& from, double alpha, double n_from, double n_to,
                                               double u1, double u2) {
  if (from.z() <= 0.0) return std::nullopt;
  const bool smooth = alpha < kSmooth;
  const Eigen::Vector3d normal = smooth ? Eigen::Vector3d::UnitZ() : sample_visible_normal(from, alpha, u1, u2);
  const Eigen::Vector3d to = 2.0 * from.dot(normal) * normal - from;
  if (to.z() <= 0.0) return std::nullopt;
  const double fresnel = fresnel_reflectance(std::clamp(from.dot(normal), 0.0, 1.0), n_from, n_to);
  const double seen_by_both = smooth ? 1.0 : ggx_visibility(from, to, alpha) * (1.0 + ggx_lambda(from, alpha));
  return GgxSample{to, fresnel * seen_by_both};
}

double ggx_reflection_pdf(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double alpha) {
  assert(alpha >= kSmooth);
  if (from.z() <= 0.0 || to.z() <= 0.0) return 0.0;
  const Eigen::Vector3d half = (from + to).normalized();
  return visible_normal_pdf(from, half, alpha) / (4.0 * from.dot(half));
}

}  // namespace fathom
