#include "detector/segments.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace fathom {
namespace {

/// Square cells of the desk around the camera's foot, with a border that no point reaches.
class Grid {
 public:
  explicit Grid(const SegmentSearch& search)
      : per_metre_(static_cast<float>(1.0 / search.cell_m)),
        reach_(static_cast<float>(search.reach_m)),
        border_(1 + search.gap_cells),
        side_(2 * (static_cast<int>(std::ceil(search.reach_m / search.cell_m)) + border_) + 1) {
    for (int y = -border_; y <= border_; ++y)
      for (int x = -border_; x <= border_; ++x)
        if (x != 0 || y != 0) steps_.push_back(y * side_ + x);
  }

  std::size_t cells() const { return static_cast<std::size_t>(side_) * side_; }
  bool holds(const Eigen::Vector3f& point) const {
    return std::abs(point.x()) < reach_ && std::abs(point.y()) < reach_;
  }
  int cell_of(const Eigen::Vector3f& point) const {
    const auto along = [this](float metres) { return border_ + static_cast<int>((metres + reach_) * per_metre_); };
    return along(point.y()) * side_ + along(point.x());
  }
  /// From a cell to those that belong to the same segment.
  const std::vector<int>& steps() const { return steps_; }

 private:
  float per_metre_, reach_;
  int border_, side_;
  std::vector<int> steps_;
};

constexpr int kEmpty = 0, kOccupied = -1;  // other labels count from 1

/// Gives each group of touching occupied cells its label; returns their number.
int label_cells(std::vector<int>& labels, const std::vector<int>& occupied, const Grid& grid) {
  int count = 0;
  std::vector<int> open;
  for (const int start : occupied) {
    if (labels[start] != kOccupied) continue;
    labels[start] = ++count;
    open.assign(1, start);
    while (!open.empty()) {
      const int cell = open.back();
      open.pop_back();
      for (const int step : grid.steps())
        if (labels[cell + step] == kOccupied) {
          labels[cell + step] = count;
          open.push_back(cell + step);
        }
    }
  }
  return count;
}

}  // namespace

std::vector<Points> grid_segments(const Points& points, const SegmentSearch& search) {
  const Grid grid(search);
  std::vector<int> labels(grid.cells(), kEmpty), occupied, above;
  const float low = static_cast<float>(search.low_m), high = static_cast<float>(search.high_m);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(points[i].z() > low && points[i].z() < high) || !grid.holds(points[i])) continue;
    above.push_back(static_cast<int>(i));
    int& label = labels[grid.cell_of(points[i])];
    if (label == kEmpty) occupied.push_back(grid.cell_of(points[i]));
    label = kOccupied;
  }
  std::vector<Points> segments(label_cells(labels, occupied, grid));
  for (const int i : above) segments[labels[grid.cell_of(points[i])] - 1].push_back(points[i]);
  std::erase_if(segments, [&](const Points& segment) { return static_cast<int>(segment.size()) < search.points_min; });
  return segments;
}

}  // namespace fathom
