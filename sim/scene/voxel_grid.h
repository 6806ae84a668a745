// Space around a body cut into cubes: which of them a surface passes through, and how high a liquid must climb to reach
// the others.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace fathom {

using Triangle = std::array<Eigen::Vector3d, 3>;

/// Cubes of edge `size` [m]; voxel (i, j, k) starts at origin + size (i, j, k).
struct VoxelGrid {
  Eigen::Vector3d origin;
  double size;
  Eigen::Vector3i count;

  std::size_t total() const { return std::size_t(count.x()) * std::size_t(count.y()) * std::size_t(count.z()); }
  std::size_t index(int i, int j, int k) const {
    return (std::size_t(k) * std::size_t(count.y()) + std::size_t(j)) * std::size_t(count.x()) + std::size_t(i);
  }
  Eigen::Vector3i voxel(std::size_t index) const;
  /// Where a coordinate [m] along an axis falls; outside the grid for coordinates outside.
  int cell(int axis, double coordinate) const;
  double edge(int axis, int cell) const { return origin[axis] + size * cell; }       ///< lower edge [m]
  double centre(int axis, int cell) const { return edge(axis, cell) + 0.5 * size; }  ///< [m]
};

/// A grid with two empty voxels all around the triangles.
VoxelGrid grid_around(std::span<const Triangle> triangles, double size);

/// 1 for every voxel that a triangle touches, 0 elsewhere. A gap narrower than a voxel leaves no 0 in it.
std::vector<std::uint8_t> touched_voxels(const VoxelGrid& grid, std::span<const Triangle> triangles);

inline constexpr std::int16_t kUnreached = 32767;

/// For every voxel the least, over all ways from `starts` through neighbouring (by faces) `passable` voxels, of the
/// way's highest layer k; kUnreached where no way leads.
std::vector<std::int16_t> climb(const VoxelGrid& grid, const std::vector<std::uint8_t>& passable,
                                std::span<const std::size_t> starts);

}  // namespace fathom
