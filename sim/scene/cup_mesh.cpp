#include "sim/scene/cup_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fathom {
double handle_wall(const CupShape& shape) {
  const double middle = 0.5 * (shape.handle->low + shape.handle->high);
  return 0.5 * (shape.inner_radius(middle) + shape.outer_radius(middle));
}

Mesh handle_mesh(const CupShape& shape) {
  constexpr int kAlong = 24, kAround = 12;
  const Handle& handle = *shape.handle;
  const double middle = 0.5 * (handle.low + handle.high), half = 0.5 * (handle.high - handle.low);
  const double wall = handle_wall(shape);
  Mesh mesh;
  for (int i = 0; i <= kAlong; ++i) {
    const double t = std::numbers::pi * (static_cast<double>(i) / kAlong - 0.5);
    const Eigen::Vector3d centre(wall + handle.reach * std::cos(t), 0.0, middle + half * std::sin(t));
    const Eigen::Vector3d along = Eigen::Vector3d(-handle.reach * std::sin(t), 0.0, half * std::cos(t)).normalized();
    const Eigen::Vector3d side = Eigen::Vector3d::UnitY();
    const Eigen::Vector3d out = side.cross(along);
    for (int j = 0; j < kAround; ++j) {
      const double a = 2.0 * std::numbers::pi * j / kAround;
      mesh.add_vertex(centre + handle.tube_radius * (std::cos(a) * out + std::sin(a) * side));
    }
  }
  for (int i = 0; i < kAlong; ++i)
    for (int j = 0; j < kAround; ++j) {
      const int next = (j + 1) % kAround;
      const int low = i * kAround, high = low + kAround;
      mesh.add_triangle(low + j, low + next, high + next);
      mesh.add_triangle(low + j, high + next, high + j);
    }
  return mesh;
}

Mesh cup_mesh(const CupShape& shape) {
  std::vector<Eigen::Vector2d> outer = shape.outer;
  outer.push_back(shape.inner.back());  // the rim's top
  Mesh mesh = revolve(outer, true);
  mesh.append(revolve(shape.inner, false));
  if (shape.handle) mesh.append(handle_mesh(shape));
  return mesh;
}

std::vector<WallPart> wall_parts(const CupShape& shape, double sink) {
  std::vector<Eigen::Vector2d> outer = shape.outer;
  for (Eigen::Vector2d& point : outer)
    if (point.y() == 0.0) point.y() = -sink;
  outer.push_back(shape.inner.back());  // the rim's top
  std::vector<WallPart> parts;
  const auto add = [&](const std::vector<Eigen::Vector2d>& profile, bool outward) {
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
      const Eigen::Vector2d &a = profile[i], &b = profile[i + 1];
      if (a == b) continue;
      WallPart& part = parts.emplace_back();
      part.mesh = revolve({a, b}, outward);
      const double slope = (b.x() - a.x()) / (b.y() - a.y());
      if (a.y() != b.y()) part.cone = Eigen::Vector2d(a.x() - slope * a.y(), slope);
    }
  };
  add(outer, true);
  add(shape.inner, false);
  return parts;
}

Mesh liquid_disc(const CupShape& shape, double height) {
  const double inside_wall = 0.5 * (shape.inner_radius(height) + shape.outer_radius(height));
  return revolve({{0.0, height}, {inside_wall, height}}, false);
}

}  // namespace fathom
