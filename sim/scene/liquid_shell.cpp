#include "sim/scene/liquid_top.h"

#include <algorithm>
#include <span>

namespace fathom {
namespace {

constexpr double kIntoWall = 1e-4;  // [m]

/// The inner profile moved into the solid, at right angles to each of its pieces.
std::vector<Eigen::Vector2d> profile_in_wall(const std::vector<Eigen::Vector2d>& inner) {
  const auto into_solid = [&](std::size_t i) {  // of the piece that ends at i
    const Eigen::Vector2d along = (inner[i] - inner[i - 1]).normalized();
    return Eigen::Vector2d(along.y(), -along.x());
  };
  std::vector<Eigen::Vector2d> moved = inner;
  for (std::size_t i = 0; i < inner.size(); ++i) {
    const Eigen::Vector2d before = into_solid(std::max<std::size_t>(i, 1));
    const Eigen::Vector2d after = into_solid(std::min(i + 1, inner.size() - 1));
    moved[i] += kIntoWall * (before + after) / (1.0 + before.dot(after));
    if (inner[i].x() == 0.0) moved[i].x() = 0.0;
  }
  return moved;
}

/// The strip between the last two rings of `mesh`, facing down.
void close_strip(bool to_axis, Mesh& mesh) {
  const int high = static_cast<int>(mesh.vertices.size()) - 2 * kLiquidFacets, low = high + kLiquidFacets;
  for (int facet = 0; facet < kLiquidFacets; ++facet) {
    const int next = (facet + 1) % kLiquidFacets;
    mesh.add_triangle(low + facet, high + next, high + facet);
    if (!to_axis) mesh.add_triangle(low + facet, low + next, high + next);
  }
}

}  // namespace

Mesh liquid_shell(const CupShape& shape, const LiquidTop& top, const Mesh& surface) {
  constexpr double kStep = 1e-6;  // [m] between rings where the wall's corner is dry: they must not be one
  const std::span rim = std::span(surface.vertices).last(kLiquidFacets);
  const std::vector<Eigen::Vector2d> in_wall = profile_in_wall(shape.inner);
  const auto is_wetted = [&](const Eigen::Vector2d& corner, const Eigen::Vector3d& edge) {
    const double reach = edge.head<2>().norm();
    return corner.y() + 2.0 * kIntoWall < top.at(std::min(corner.x() / reach, 1.0) * edge.head<2>()).z;
  };
  Mesh shell;
  for (const Eigen::Vector3d& edge : rim) shell.add_vertex(edge);
  int ring = 0;
  for (std::size_t i = shape.inner.size(); i-- > 0;) {
    const Eigen::Vector2d& corner = shape.inner[i];
    if (std::none_of(rim.begin(), rim.end(), [&](const auto& edge) { return is_wetted(corner, edge); })) continue;
    ++ring;
    for (const Eigen::Vector3d& edge : rim) {
      const Eigen::Vector2d xy = in_wall[i].x() * edge.head<2>().normalized();
      shell.add_vertex(is_wetted(corner, edge) ? Eigen::Vector3d(xy.x(), xy.y(), in_wall[i].y())
                                               : Eigen::Vector3d(edge - ring * kStep * Eigen::Vector3d::UnitZ()));
    }
    close_strip(in_wall[i].x() == 0.0, shell);
  }
  return shell;
}

}  // namespace fathom
