#include "sim/scene/voxel_grid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace fathom {
namespace {

/// Whether the triangle's projection on an axis misses that of the box of half-size `half` around 0. The box is taken
/// larger by more than rounding: a triangle between two voxels must not miss both.
bool misses(const Triangle& triangle, const Eigen::Vector3d& half, const Eigen::Vector3d& axis) {
  constexpr double kMoreThanRounding = 1.0 + 1e-9;
  const double a = axis.dot(triangle[0]), b = axis.dot(triangle[1]), c = axis.dot(triangle[2]);
  const double reach = half.dot(axis.cwiseAbs()) * kMoreThanRounding;
  return std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach;
}

/// Separating axes of a triangle and a box (Akenine-Möller 2001): the box's and the triangle's normals and the products
/// of their edges.
bool touches(const Triangle& triangle, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  const Eigen::Vector3d centre = 0.5 * (low + high), half = 0.5 * (high - low);
  const Triangle moved{triangle[0] - centre, triangle[1] - centre, triangle[2] - centre};
  const Triangle edges{moved[1] - moved[0], moved[2] - moved[1], moved[0] - moved[2]};
  if (misses(moved, half, edges[0].cross(edges[1]))) return false;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis);
    if (misses(moved, half, unit)) return false;
    for (const Eigen::Vector3d& edge : edges)
      if (misses(moved, half, unit.cross(edge))) return false;
  }
  return true;
}

/// Marks what the triangle touches among voxels low … high−1 by halving the block.
void mark(const VoxelGrid& grid, const Triangle& triangle, const Eigen::Vector3i& low, const Eigen::Vector3i& high,
          std::vector<std::uint8_t>& touched) {
  const Eigen::Vector3d from = grid.origin + grid.size * low.cast<double>();
  const Eigen::Vector3d to = grid.origin + grid.size * high.cast<double>();
  if (!touches(triangle, from, to)) return;
  int longest;
  const int length = (high - low).maxCoeff(&longest);
  if (length == 1) {
    touched[grid.index(low.x(), low.y(), low.z())] = 1;
    return;
  }
  Eigen::Vector3i middle_low = low, middle_high = high;
  middle_low[longest] = middle_high[longest] = low[longest] + length / 2;
  mark(grid, triangle, low, middle_high, touched);
  mark(grid, triangle, middle_low, high, touched);
}

}  // namespace

Eigen::Vector3i VoxelGrid::voxel(std::size_t index) const {
  const std::size_t row = index / std::size_t(count.x());
  return {int(index % std::size_t(count.x())), int(row % std::size_t(count.y())), int(row / std::size_t(count.y()))};
}

int VoxelGrid::cell(int axis, double coordinate) const {
  return static_cast<int>(std::floor((coordinate - origin[axis]) / size));
}

VoxelGrid grid_around(std::span<const Triangle> triangles, double size) {
  constexpr int kEmptyVoxels = 2;
  Eigen::AlignedBox3d box;
  for (const Triangle& triangle : triangles)
    for (const Eigen::Vector3d& corner : triangle) box.extend(corner);
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(kEmptyVoxels * size);
  const Eigen::Vector3d cells = (box.sizes() + 2.0 * margin) / size;
  return {box.min() - margin, size, cells.array().ceil().cast<int>() + 1};
}

std::vector<std::uint8_t> touched_voxels(const VoxelGrid& grid, std::span<const Triangle> triangles) {
  std::vector<std::uint8_t> touched(grid.total(), 0);
  for (const Triangle& triangle : triangles) {
    Eigen::Vector3i low, high;
    for (int axis = 0; axis < 3; ++axis) {
      const auto [least, most] = std::minmax({triangle[0][axis], triangle[1][axis], triangle[2][axis]});
      low[axis] = grid.cell(axis, least);
      high[axis] = grid.cell(axis, most) + 1;
    }
    mark(grid, triangle, low, high, touched);
  }
  return touched;
}

std::vector<std::int16_t> climb(const VoxelGrid& grid, const std::vector<std::uint8_t>& passable,
                                std::span<const std::size_t> starts) {
  std::vector<std::int16_t> level(grid.total(), kUnreached);
  std::vector<std::vector<std::size_t>> waiting(grid.count.z());  // by level
  const auto reach = [&](std::size_t at, int k, int from_level) {
    if (!passable[at] || level[at] != kUnreached) return;
    level[at] = static_cast<std::int16_t>(std::max(from_level, k));
    waiting[level[at]].push_back(at);
  };
  for (const std::size_t start : starts) reach(start, grid.voxel(start).z(), 0);
  const std::size_t row = std::size_t(grid.count.x()), layer = row * std::size_t(grid.count.y());
  for (int now = 0; now < grid.count.z(); ++now)
    while (!waiting[now].empty()) {
      const std::size_t at = waiting[now].back();
      waiting[now].pop_back();
      const Eigen::Vector3i v = grid.voxel(at);
      if (v.x() > 0) reach(at - 1, v.z(), now);
      if (v.x() + 1 < grid.count.x()) reach(at + 1, v.z(), now);
      if (v.y() > 0) reach(at - row, v.z(), now);
      if (v.y() + 1 < grid.count.y()) reach(at + row, v.z(), now);
      if (v.z() > 0) reach(at - layer, v.z() - 1, now);
      if (v.z() + 1 < grid.count.z()) reach(at + layer, v.z() + 1, now);
    }
  return level;
}

}  // namespace fathom
