// Space in boxes of 5 mm, for what lies near a place.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace fathom {

inline constexpr double kBox = 5e-3;  ///< [m] edge

inline Eigen::Array3i box_index(const Eigen::Array3d& point) { return (point / kBox).floor().cast<int>(); }

/// A key for maps, one to one within 5 km of the origin.
inline std::uint64_t box_key(const Eigen::Array3i& index) {
  constexpr int kHalf = 1 << 20;
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) key = key << 21 | static_cast<std::uint64_t>(index[axis] + kHalf);
  return key;
}
inline std::uint64_t box_around(const Eigen::Vector3d& point) { return box_key(box_index(point.array())); }

/// Calls `visit(key)` for each box that has a part within `around` [m] of a place along all axes.
template <class Visit>
void for_each_box(const Eigen::Vector3d& middle, double around, Visit visit) {
  const Eigen::Array3i low = box_index(middle.array() - around), high = box_index(middle.array() + around);
  for (int i = low.x(); i <= high.x(); ++i)
    for (int j = low.y(); j <= high.y(); ++j)
      for (int k = low.z(); k <= high.z(); ++k) visit(box_key({i, j, k}));
}

}  // namespace fathom
