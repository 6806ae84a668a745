#include "diagnosis/predict/cup_walls.h"

#include <cmath>

namespace fathom {
namespace {

struct WallHit {
  Eigen::Vector3d point;
  Eigen::Vector3d outward;  ///< unit normal
};

/// Where a ray comes in through a wall from outside, or from inside meets it: the nearest such place of a profile of
/// (radius, height). Each piece is a cone, radius = radius at height 0 + lean · z, a quadratic in the ray's length.
std::optional<WallHit> meet_wall(const std::vector<Eigen::Vector2d>& profile, const Eigen::Vector2d& axis,
                                 const Ray& ray, bool from_inside) {
  const Eigen::Vector2d from = ray.origin.head<2>() - axis, along = ray.direction.head<2>();
  double nearest = INFINITY;
  WallHit hit;
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const Eigen::Vector2d run = profile[i] - profile[i - 1];
    if (run.y() <= std::abs(run.x())) continue;  // a bottom, or a rim
    const double lean = run.x() / run.y();
    const double radius = profile[i].x() + lean * (ray.origin.z() - profile[i].y());
    const double widens = lean * ray.direction.z();
    const double a = along.squaredNorm() - widens * widens, b = from.dot(along) - radius * widens,
                 c = from.squaredNorm() - radius * radius;
    const double root = b * b - a * c;
    if (a <= 0.0 || root < 0.0) continue;
    const double t = (-b + (from_inside ? 1.0 : -1.0) * std::sqrt(root)) / a;
    const Eigen::Vector3d point = ray.origin + t * ray.direction;
    if (t <= 0.0 || t >= nearest || point.z() < profile[i - 1].y() || point.z() > profile[i].y()) continue;
    const Eigen::Vector2d out = (point.head<2>() - axis).normalized();
    nearest = t;
    hit = {point, Eigen::Vector3d(out.x(), out.y(), -lean).normalized()};
  }
  return std::isfinite(nearest) ? std::optional(hit) : std::nullopt;
}

double distance_at_rim(const CupBody& cup, const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d there = from + (cup.rim - from.z()) / direction.z() * direction;
  return (there.head<2>() - cup.axis).norm();
}

bool is_dry(const LiquidTop* surface, const Eigen::Vector3d& point) {
  return !surface || point.z() > surface->at(point.head<2>()).z;
}

}  // namespace

std::optional<LitPoint> look_at_wall(const CupBody& cup, const LiquidTop* surface, const Ray& camera_ray,
                                     const Eigen::Vector3d& projector) {
  if (camera_ray.direction.z() >= 0.0) return std::nullopt;
  const double at_rim = distance_at_rim(cup, camera_ray.origin, camera_ray.direction);
  const bool is_inside = at_rim < cup.rim_radius;
  if (!is_inside && at_rim < cup.outer.back().x()) return std::nullopt;  // the rim
  const auto hit = meet_wall(is_inside ? cup.inner : cup.outer, cup.axis, camera_ray, is_inside);
  if (!hit || (is_inside && !is_dry(surface, hit->point))) return std::nullopt;
  const Eigen::Vector3d way = hit->point - projector;
  const double distance = way.norm();
  const Eigen::Vector3d direction = way / distance;
  const double cosine = direction.dot(is_inside ? hit->outward : -hit->outward);
  if (cosine <= 0.0) return std::nullopt;
  if (is_inside && distance_at_rim(cup, projector, direction) >= cup.rim_radius) return std::nullopt;
  return LitPoint{hit->point, direction, cup.albedo * cosine / (distance * distance)};
}

}  // namespace fathom
