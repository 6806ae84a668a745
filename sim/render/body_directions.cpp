#include "sim/render/body_directions.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace fathom {
namespace {

using GridCell = std::pair<int, int>;

/// A gnomonic grid about an axis, as the source sees it.
struct DirectionGrid {
  const Eigen::Vector3d& source;
  const Eigen::Vector3d& axis;
  Matrix32d basis;

  DirectionCell cell(const GridCell& at) const {
    const Eigen::Vector2d steps(at.first + 0.5, at.second + 0.5);
    const Eigen::Vector3d middle = (axis + basis * steps * kDirectionSpacing).normalized();
    return {middle, basis, middle.dot(axis)};
  }
  /// In cells; nothing far off the axis.
  std::optional<Eigen::Array2d> place(const Eigen::Vector3d& point) const {
    constexpr double kWidest = 0.1;  // cosine: 84° off the axis
    const Eigen::Vector3d towards = point - source;
    const double along = towards.dot(axis);
    if (along < kWidest * towards.norm()) return std::nullopt;
    return (basis.transpose() * towards / along).array() / kDirectionSpacing;
  }
};

std::vector<GridCell> covered_cells(const Geometry& geometry, const DirectionGrid& grid) {
  std::vector<GridCell> cells;
  std::vector<std::optional<Eigen::Array2d>> places;  // of vertices
  for (const Surface& surface : geometry.surfaces) {
    if (!std::holds_alternative<Interface>(surface.optics)) continue;
    places.clear();
    for (const Eigen::Vector3d& vertex : surface.mesh.vertices) places.push_back(grid.place(vertex));
    for (const Eigen::Vector3i& triangle : surface.mesh.triangles) {
      Eigen::Array2d low = Eigen::Array2d::Constant(1e9), high = -low;
      for (const int corner : triangle)
        if (places[corner]) low = low.min(*places[corner]), high = high.max(*places[corner]);
      for (int i = static_cast<int>(std::floor(low.x())); i <= high.x(); ++i)
        for (int j = static_cast<int>(std::floor(low.y())); j <= high.y(); ++j) cells.emplace_back(i, j);
    }
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

Eigen::Vector3d mean_direction(const Geometry& geometry, const Eigen::Vector3d& source) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Surface& surface : geometry.surfaces)
    if (std::holds_alternative<Interface>(surface.optics))
      for (const Eigen::Vector3d& vertex : surface.mesh.vertices) sum += (vertex - source).normalized();
  return sum.norm() > 0.0 ? Eigen::Vector3d(sum.normalized()) : -Eigen::Vector3d::UnitZ();
}

}  // namespace

std::vector<DirectionCell> directions_to_bodies(const Geometry& geometry, const Eigen::Vector3d& source) {
  const Eigen::Vector3d axis = mean_direction(geometry, source);
  const DirectionGrid grid{source, axis, perpendicular_to(axis)};
  std::vector<DirectionCell> cells;
  for (const GridCell& at : covered_cells(geometry, grid)) cells.push_back(grid.cell(at));
  return cells;
}

}  // namespace fathom
