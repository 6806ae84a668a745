// Circles in thin slabs of height, by RANSAC.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

#include "detector/cloud.h"

namespace fathom {

/// Where and how finely round walls are looked for.
struct WallSearch {
  double low_m = 0.020;         ///< below, a foot may be rounded and the bottom's points mix in
  double high_m = 0.170;        ///< the tallest cups' rims
  double slab_m = 0.008;        ///< a wall that leans 10° moves 1.4 mm in it
  double tolerance_m = 0.003;   ///< half a wall's thickness of 3 to 5 mm, plus noise of 1 to 2 mm
  double radius_min_m = 0.015;  ///< wider than what cups are: the wide ones get a reason, too
  double radius_max_m = 0.100;
  int hypotheses = 300;   ///< a cup beside two others holds a third of a slab: 11 of 300 draws are its own
  int slab_points = 400;  ///< drawn of each slab
  double arc_min = 0.30;  ///< share of the directions; a corner of a box reaches 0.36 and fails elsewhere
  int walls_max = 8;      ///< of one segment
  int rounds_max = 16;    ///< of looking for them; lids and corners take some in vain
};

/// Directions about an axis, told apart without an angle.
inline constexpr int kDirections = 32;

/// One of 32 equal directions, in no order: octants, and in each three bounds.
inline unsigned direction_bit(const Eigen::Vector2f& v) {
  const float x = std::abs(v.x()), y = std::abs(v.y()), small = std::min(x, y), large = std::max(x, y);
  const unsigned octant = (v.x() < 0.0f) | (v.y() < 0.0f) << 1 | (y > x) << 2;
  const unsigned part = (small > 0.19891f * large) + (small > 0.41421f * large) + (small > 0.66818f * large);
  return 1u << (octant << 2 | part);
}

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
