#include "detector/cluster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>

namespace fathom {
namespace {

/// Disjoint sets of cells, by the smallest number in each.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int a, int b) {
    a = root(a), b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<int> parent_;
};

using CellIndex = std::array<std::int32_t, 3>;

struct Cell {
  CellIndex index;
  std::size_t begin, end;  ///< of its points in the sorted order
};

/// The points sorted by the cube of this side that they lie in.
struct Cells {
  std::vector<int> order;
  std::vector<Cell> cells;  ///< in ascending order of their index

  std::optional<int> at(const CellIndex& index) const {
    const auto cell = std::lower_bound(cells.begin(), cells.end(), index,
                                       [](const Cell& a, const CellIndex& b) { return a.index < b; });
    if (cell == cells.end() || cell->index != index) return std::nullopt;
    return static_cast<int>(cell - cells.begin());
  }
};

Cells sort_into_cells(const Points& points, double side_m) {
  std::vector<std::pair<CellIndex, int>> keyed(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Array3d scaled = (points[i].cast<double>() / side_m).array().floor().max(-1e9).min(1e9);
    const Eigen::Array3i index = scaled.cast<int>();
    keyed[i] = {{index[0], index[1], index[2]}, static_cast<int>(i)};
  }
  std::sort(keyed.begin(), keyed.end());
  Cells result;
  result.order.reserve(points.size());
  for (std::size_t i = 0; i < keyed.size(); ++i) {
    if (i == 0 || keyed[i].first != keyed[i - 1].first) result.cells.push_back({keyed[i].first, i, i});
    result.cells.back().end = i + 1;
    result.order.push_back(keyed[i].second);
  }
  return result;
}

bool any_within(const Points& points, const Cells& sorted, const Cell& a, const Cell& b, double distance_m) {
  const float squared = static_cast<float>(distance_m * distance_m);
  for (std::size_t i = a.begin; i < a.end; ++i)
    for (std::size_t j = b.begin; j < b.end; ++j)
      if ((points[sorted.order[i]] - points[sorted.order[j]]).squaredNorm() <= squared) return true;
  return false;
}

/// Half of the cells around one that a step of its diagonal can reach; the others find this one. The nearest first:
/// most cells are joined by them, and what is joined needs no look at its points.
std::vector<CellIndex> neighbour_offsets() {
  std::vector<CellIndex> offsets;
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      for (int z = -2; z <= 2; ++z)
        if (CellIndex{x, y, z} > CellIndex{0, 0, 0}) offsets.push_back({x, y, z});
  const auto far = [](const CellIndex& o) { return o[0] * o[0] + o[1] * o[1] + o[2] * o[2]; };
  std::stable_sort(offsets.begin(), offsets.end(), [&](const auto& a, const auto& b) { return far(a) < far(b); });
  return offsets;
}

}  // namespace

std::vector<Points> euclidean_clusters(const Points& points, double distance_m, int points_min) {
  // Cubes whose diagonal is a bit less than a step: the points of one are connected, and a step reaches two cubes far.
  const Cells sorted = sort_into_cells(points, 0.9999 * distance_m / std::sqrt(3.0));
  Sets sets(sorted.cells.size());
  for (const CellIndex& offset : neighbour_offsets())
    for (std::size_t i = 0; i < sorted.cells.size(); ++i) {
      const CellIndex& index = sorted.cells[i].index;
      const auto other = sorted.at({index[0] + offset[0], index[1] + offset[1], index[2] + offset[2]});
      if (!other || sets.root(static_cast<int>(i)) == sets.root(*other)) continue;
      if (any_within(points, sorted, sorted.cells[i], sorted.cells[*other], distance_m))
        sets.join(static_cast<int>(i), *other);
    }

  std::vector<int> set_of(points.size());
  for (std::size_t i = 0; i < sorted.cells.size(); ++i)
    for (std::size_t k = sorted.cells[i].begin; k < sorted.cells[i].end; ++k)
      set_of[sorted.order[k]] = sets.root(static_cast<int>(i));
  std::vector<Points> groups(sorted.cells.size());
  for (std::size_t i = 0; i < points.size(); ++i) groups[set_of[i]].push_back(points[i]);
  std::erase_if(groups,
                [&](const Points& group) { return group.empty() || static_cast<int>(group.size()) < points_min; });
  std::stable_sort(groups.begin(), groups.end(), [](const Points& a, const Points& b) { return a.size() > b.size(); });
  return groups;
}

}  // namespace fathom
