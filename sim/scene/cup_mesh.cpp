#include "sim/scene/cup_mesh.h"

#include <cmath>
#include <numbers>

namespace fathom {
namespace {

Eigen::Vector3d on_circle(double radius, double height, int facet) {
  const double angle = 2.0 * std::numbers::pi * facet / kFacetsAround;
  return {radius * std::cos(angle), radius * std::sin(angle), height};
}

/// Revolves a profile; with `outward` the faces look away from the axis (or down), otherwise towards it (or up).
Mesh revolve(const std::vector<Eigen::Vector2d>& profile, bool outward) {
  Mesh mesh;
  for (const Eigen::Vector2d& point : profile)
    for (int facet = 0; facet < kFacetsAround; ++facet) mesh.add_vertex(on_circle(point.x(), point.y(), facet));
  const auto add = [&](int a, int b, int c) { outward ? mesh.add_triangle(a, b, c) : mesh.add_triangle(a, c, b); };
  for (int ring = 0; ring + 1 < static_cast<int>(profile.size()); ++ring) {
    const bool from_axis = profile[ring].x() == 0.0, to_axis = profile[ring + 1].x() == 0.0;
    for (int facet = 0; facet < kFacetsAround; ++facet) {
      const int next = (facet + 1) % kFacetsAround;
      const int low = ring * kFacetsAround, high = low + kFacetsAround;
      if (!from_axis) add(low + facet, low + next, high + next);
      if (!to_axis) add(low + facet, high + next, high + facet);
    }
  }
  return mesh;
}

Mesh handle_mesh(const CupShape& shape) {
  constexpr int kAlong = 24, kAround = 12;
  const Handle& handle = *shape.handle;
  const double middle = 0.5 * (handle.low + handle.high), half = 0.5 * (handle.high - handle.low);
  const double wall = 0.5 * (shape.inner_radius(middle) + shape.outer_radius(middle));
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

}  // namespace

Mesh cup_mesh(const CupShape& shape) {
  std::vector<Eigen::Vector2d> outer = shape.outer;
  outer.push_back(shape.inner.back());  // the rim's top
  Mesh mesh = revolve(outer, true);
  mesh.append(revolve(shape.inner, false));
  if (shape.handle) mesh.append(handle_mesh(shape));
  return mesh;
}

Mesh liquid_disc(const CupShape& shape, double height) {
  const double inside_wall = 0.5 * (shape.inner_radius(height) + shape.outer_radius(height));
  return revolve({{0.0, height}, {inside_wall, height}}, false);
}

}  // namespace fathom
