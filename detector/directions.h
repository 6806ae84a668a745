// Directions about an axis, told apart without an angle.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace fathom {

inline constexpr int kDirections = 32;

/// One of 32 equal directions, in no order: octants, and in each three bounds.
inline unsigned direction_bit(const Eigen::Vector2f& v) {
  const float x = std::abs(v.x()), y = std::abs(v.y()), small = std::min(x, y), large = std::max(x, y);
  const unsigned octant = (v.x() < 0.0f) | (v.y() < 0.0f) << 1 | (y > x) << 2;
  const unsigned part = (small > 0.19891f * large) + (small > 0.41421f * large) + (small > 0.66818f * large);
  return 1u << (octant << 2 | part);
}

}  // namespace fathom
