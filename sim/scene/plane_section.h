// Level sections of triangles: the lines in which they cut a horizontal plane.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "sim/scene/voxel_grid.h"

namespace fathom {

struct Segment {
  Eigen::Vector2d from, to;  ///< [m] x and y
};

/// Where the triangles cut the plane at height `z` [m]. A corner exactly at z counts as above, so that the section of a
/// closed mesh consists of closed lines at every height; triangles that share an edge share the cut's end, bit for bit.
/// Loose ends closer than `bridge` [m] are joined, nearest first: cracks between sheets.
std::vector<Segment> plane_section(std::span<const Triangle> triangles, double z, double bridge);

}  // namespace fathom
