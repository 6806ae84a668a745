// Circles in thin slabs of height, by RANSAC.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "detector/cloud.h"
#include "detector/wall_search.h"

namespace fathom {

/// A wall that is open at the top has nothing above it, a closed one may.
enum class Top { kOpen, kAny };

struct SlabCircle {
  Eigen::Vector2f center;
  float radius;
  float height;  ///< of the slab's middle
  float score;   ///< directions of kDirections in which points lie on it, fewer for points that a wall would not have
};

/// The best of the hypotheses over all slabs; equal points and rounds give equal circles.
std::optional<SlabCircle> best_slab_circle(const Points& segment, const WallSearch& search, Top top, int round);

}  // namespace fathom
