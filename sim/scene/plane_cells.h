// A horizontal plane cut along the walls' sections into cells, and those of them that belong to a cavity.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/scene/mesh.h"
#include "sim/scene/plane_section.h"
#include "sim/scene/voxel_grid.h"

namespace fathom {

/// What a voxel is to a cavity: kWall where a surface passes, kOutside in open space, kSealed in hollows of walls,
/// otherwise the layer up to which a liquid must rise in the cavity's deepest place to come there.
inline constexpr std::int16_t kWall = -1, kOutside = -2, kSealed = -3;

/// A point that is known to lie in the cavity.
struct InsidePoint {
  Eigen::Vector2d at;
  std::int16_t layer;  ///< up to which the liquid must rise to come there
};

/// A trapezoid between two lines of constant y.
struct Cell {
  double y[2], left[2], right[2];  ///< [m] at the lower and the upper y
  std::int16_t layer;              ///< as of a voxel; kWall where it holds no whole voxel and no liquid comes

  double area() const { return 0.5 * (right[0] - left[0] + right[1] - left[1]) * (y[1] - y[0]); }
  bool contains(const Eigen::Vector2d& point) const {
    const double t = (point.y() - y[0]) / (y[1] - y[0]);
    return t >= 0.0 && t <= 1.0 && point.x() >= left[0] + t * (left[1] - left[0]) &&
           point.x() <= right[0] + t * (right[1] - right[0]);
  }
};

/// An opening through which a liquid at the plane's height would leave.
struct Leak {
  double width = 0.0;                           ///< [m] of all openings together
  double widest = 0.0;                          ///< [m] of one cell's
  Eigen::Vector2d at{Eigen::Vector2d::Zero()};  ///< the widest one's middle
};

struct PlaneCells {
  std::vector<Cell> cells;
  Leak leak;
};

/// The cells of the plane between the segments, each labelled by the voxels and points in it: `labels` of the grid's
/// layer [count.x · count.y]. Cells without a
/// voxel are the cavity's when they are open towards it, the cells of voxels first, then those of the points in their
/// order. A cell that reaches from the cavity through a crack to voxels that are not the cavity's is cut in the middle
/// of the wall. Segments of constant y separate nothing: callers turn the plane so that there are none.
PlaneCells plane_cells(const VoxelGrid& grid, std::span<const std::int16_t> labels, std::span<const Segment> segments,
                       std::span<const InsidePoint> inside);

/// The cells that a liquid up to `layer` fills as a conforming mesh at height z, faces up.
Mesh mesh_of_cells(std::span<const Cell> cells, int layer, double z);

}  // namespace fathom
