#include "sim/scene/plane_cells.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace fathom {
namespace {

/// Touching less than this is no opening [m]: rounding of the crossings of segments.
constexpr double kTouching = 1e-7;

double x_at(const Segment& s, double y) {
  if (s.from.y() == s.to.y()) return 0.5 * (s.from.x() + s.to.x());
  const double t = std::clamp((y - s.from.y()) / (s.to.y() - s.from.y()), 0.0, 1.0);
  return s.from.x() + t * (s.to.x() - s.from.x());
}

/// y of the point in which two segments cross, if they do.
std::optional<double> crossing(const Segment& a, const Segment& b) {
  const Eigen::Vector2d u = a.to - a.from, v = b.to - b.from, w = b.from - a.from;
  const double cross = u.x() * v.y() - u.y() * v.x();
  if (cross == 0.0) return std::nullopt;
  const double s = (w.x() * v.y() - w.y() * v.x()) / cross, t = (w.x() * u.y() - w.y() * u.x()) / cross;
  if (s <= 0.0 || s >= 1.0 || t <= 0.0 || t >= 1.0) return std::nullopt;
  return a.from.y() + s * u.y();
}

class Decomposition {
 public:
  Decomposition(const VoxelGrid& grid, std::span<const std::int16_t> labels) : grid_(grid), labels_(labels) {}

  /// Cells of one row of voxels, from segments that reach into it.
  void add_row(int row, const std::vector<Segment>& segments) {
    const double low = grid_.edge(1, row), high = grid_.edge(1, row + 1);
    std::vector<double> ys{low, high};
    const auto add = [&](double y) {
      if (y > low && y < high) ys.push_back(y);
    };
    for (std::size_t i = 0; i < segments.size(); ++i) {
      add(segments[i].from.y());
      add(segments[i].to.y());
      for (std::size_t j = 0; j < i; ++j)
        if (const std::optional<double> y = crossing(segments[i], segments[j])) add(*y);
    }
    std::sort(ys.begin(), ys.end());
    ys.erase(std::unique(ys.begin(), ys.end()), ys.end());
    for (std::size_t i = 1; i < ys.size(); ++i) add_slab(row, ys[i - 1], ys[i], segments);
  }

  /// Finds which cells touch, after the last row.
  void connect() {
    slabs_.push_back(cells_.size());
    neighbours_.resize(cells_.size());
    for (std::size_t s = 1; s + 1 < slabs_.size(); ++s) {
      std::size_t a = slabs_[s - 1], b = slabs_[s];
      while (a < slabs_[s] && b < slabs_[s + 1]) {
        const double left = std::max(cells_[a].left[1], cells_[b].left[0]);
        const double right = std::min(cells_[a].right[1], cells_[b].right[0]);
        if (right - left > kTouching) {
          neighbours_[a].push_back({b, left, right});
          neighbours_[b].push_back({a, left, right});
        }
        cells_[a].right[1] < cells_[b].right[0] ? ++a : ++b;
      }
    }
  }

  /// Liquid spreads from the cavity's voxels, then from points where it has not come yet.
  void fill(std::span<const InsidePoint> points) {
    for (std::size_t i = 0, count = cells_.size(); i < count; ++i)
      if (cells_[i].layer >= 0) wet_.push_back(i);
    spread();
    for (const InsidePoint& point : points) {
      const std::optional<std::size_t> cell = cell_at(point.at);
      if (!cell || cells_[*cell].layer != kWall) continue;
      cells_[*cell].layer = point.layer;
      wet_.push_back(*cell);
      spread();
    }
  }

  PlaneCells result() && { return {std::move(cells_), leak_}; }

 private:
  /// A cell and the edge that it has in common with another.
  struct Neighbour {
    std::size_t cell;
    double left, right;
  };

  void add_slab(int row, double low, double high, const std::vector<Segment>& segments) {
    slabs_.push_back(cells_.size());
    const double middle = 0.5 * (low + high);
    std::vector<std::pair<double, const Segment*>> walls;
    for (const Segment& s : segments)
      if (std::min(s.from.y(), s.to.y()) < middle && std::max(s.from.y(), s.to.y()) > middle)
        walls.emplace_back(x_at(s, middle), &s);
    std::sort(walls.begin(), walls.end());
    Cell cell{{low, high}, {grid_.edge(0, 0), grid_.edge(0, 0)}, {}, kWall};
    for (const auto& [x, wall] : walls) {
      for (int end : {0, 1}) cell.right[end] = std::max(x_at(*wall, cell.y[end]), cell.left[end]);
      add_labelled(row, cell);
      for (int end : {0, 1}) cell.left[end] = cell.right[end];
    }
    cell.right[0] = cell.right[1] = grid_.edge(0, grid_.count.x());
    add_labelled(row, cell);
  }

  /// Labels a cell by the voxels whose centres it holds; cuts it where it holds some of the cavity and some outside.
  void add_labelled(int row, Cell cell) {
    const double left = 0.5 * (cell.left[0] + cell.left[1]), right = 0.5 * (cell.right[0] + cell.right[1]);
    const int first = std::max(grid_.cell(0, left + 0.5 * grid_.size), 0);
    const int last = std::min(grid_.cell(0, right - 0.5 * grid_.size), grid_.count.x() - 1);
    const std::int16_t* labels = labels_.data() + std::size_t(row) * std::size_t(grid_.count.x());
    int free = -1;  // the last voxel that is no wall
    for (int i = first; i <= last; ++i) {
      if (labels[i] == kWall) continue;
      if (free >= 0 && (labels[i] < 0) != (labels[free] < 0)) {
        const double x = 0.5 * (grid_.edge(0, free + 1) + grid_.edge(0, i));
        Cell rest = cell;
        for (int end : {0, 1}) {
          cell.right[end] = std::clamp(x, cell.left[end], cell.right[end]);
          rest.left[end] = cell.right[end];
        }
        if (labels[i] == kOutside || labels[free] == kOutside)
          add_leak(cell.y[1] - cell.y[0], {x, 0.5 * (cell.y[0] + cell.y[1])});
        cells_.push_back(cell);
        cell = rest;
      }
      cell.layer = labels[i];
      free = i;
    }
    cells_.push_back(cell);
  }

  /// From wet cells into those that hold no voxel; towards those outside it leaks.
  void spread() {
    while (!wet_.empty()) {
      const std::size_t at = wet_.back();
      wet_.pop_back();
      for (const auto& [next, left, right] : neighbours_[at]) {
        if (cells_[next].layer == kOutside)
          add_leak(right - left, {0.5 * (left + right), cells_[at].y[next > at ? 1 : 0]});
        if (cells_[next].layer != kWall) continue;
        cells_[next].layer = cells_[at].layer;
        wet_.push_back(next);
      }
    }
  }

  std::optional<std::size_t> cell_at(const Eigen::Vector2d& point) const {
    // Cells stand in the order of y, then x; those of equal y form a slab.
    const auto slab = std::upper_bound(slabs_.begin(), slabs_.end() - 1, point.y(),
                                       [&](double y, std::size_t first) { return y < cells_[first].y[0]; });
    if (slab == slabs_.begin()) return std::nullopt;
    for (std::size_t i = *(slab - 1); i < *slab; ++i)
      if (cells_[i].contains(point)) return i;
    return std::nullopt;
  }

  void add_leak(double width, const Eigen::Vector2d& at) {
    leak_.width += width;
    if (width <= leak_.widest) return;
    leak_.widest = width;
    leak_.at = at;
  }

  const VoxelGrid& grid_;
  std::span<const std::int16_t> labels_;
  std::vector<Cell> cells_;
  std::vector<std::size_t> slabs_;  ///< each one's first cell, and one beyond the last
  std::vector<std::vector<Neighbour>> neighbours_;
  std::vector<std::size_t> wet_;
  Leak leak_;
};

/// The xs of all corners on one line between slabs, sorted, with the number of the first as a vertex.
struct CornerLine {
  std::vector<double> xs;
  int first = 0;
};

/// Corners between `left` and `right` on a line.
std::pair<int, int> corners_between(const CornerLine& line, double left, double right) {
  const auto from = std::lower_bound(line.xs.begin(), line.xs.end(), left - kTouching);
  const auto to = std::upper_bound(line.xs.begin(), line.xs.end(), right + kTouching);
  const int begin = static_cast<int>(from - line.xs.begin());
  return {begin, std::max(begin, static_cast<int>(to - line.xs.begin()) - 1)};
}

}  // namespace

PlaneCells plane_cells(const VoxelGrid& grid, std::span<const std::int16_t> labels, std::span<const Segment> segments,
                       std::span<const InsidePoint> inside) {
  std::vector<std::vector<Segment>> by_row(grid.count.y());
  for (const Segment& s : segments) {
    const int low = grid.cell(1, std::min(s.from.y(), s.to.y())), high = grid.cell(1, std::max(s.from.y(), s.to.y()));
    for (int row = low; row <= high; ++row) by_row[row].push_back(s);
  }
  Decomposition plane(grid, labels);
  for (int row = 0; row < grid.count.y(); ++row) plane.add_row(row, by_row[row]);
  plane.connect();
  plane.fill(inside);
  return std::move(plane).result();
}

Mesh mesh_of_cells(std::span<const Cell> cells, int layer, double z) {
  std::vector<double> ys;
  for (const Cell& cell : cells)
    if (cell.layer >= 0 && cell.layer <= layer) ys.insert(ys.end(), {cell.y[0], cell.y[1]});
  std::sort(ys.begin(), ys.end());
  ys.erase(std::unique(ys.begin(), ys.end()), ys.end());
  const auto line_of = [&](double y) { return std::size_t(std::lower_bound(ys.begin(), ys.end(), y) - ys.begin()); };

  std::vector<CornerLine> lines(ys.size());
  for (const Cell& cell : cells)
    if (cell.layer >= 0 && cell.layer <= layer)
      for (int end : {0, 1}) {
        std::vector<double>& xs = lines[line_of(cell.y[end])].xs;
        xs.insert(xs.end(), {cell.left[end], cell.right[end]});
      }
  Mesh mesh;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::vector<double>& xs = lines[i].xs;
    std::sort(xs.begin(), xs.end());
    xs.erase(std::unique(xs.begin(), xs.end(), [](double a, double b) { return b - a < 2.0 * kTouching; }), xs.end());
    lines[i].first = static_cast<int>(mesh.vertices.size());
    for (const double x : xs) mesh.add_vertex({x, ys[i], z});
  }
  for (const Cell& cell : cells) {
    if (cell.layer < 0 || cell.layer > layer) continue;
    const CornerLine &low = lines[line_of(cell.y[0])], &high = lines[line_of(cell.y[1])];
    auto [a, a_end] = corners_between(low, cell.left[0], cell.right[0]);
    auto [b, b_end] = corners_between(high, cell.left[1], cell.right[1]);
    while (a < a_end || b < b_end) {  // a strip between both lines, the nearer corner next
      const bool along_low = b == b_end || (a < a_end && low.xs[a + 1] < high.xs[b + 1]);
      if (along_low) {
        mesh.add_triangle(low.first + a, low.first + a + 1, high.first + b);
        ++a;
      } else {
        mesh.add_triangle(low.first + a, high.first + b + 1, high.first + b);
        ++b;
      }
    }
  }
  return mesh;
}

}  // namespace fathom
