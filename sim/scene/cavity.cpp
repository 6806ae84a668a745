#include "sim/scene/cavity.h"

#include <algorithm>
#include <cmath>

#include "sim/scene/liquid_edge.h"

namespace fathom {
namespace {

constexpr double kFinestVoxel = 0.5e-3;  // [m]
constexpr double kMostVoxels = 12e6;

/// The grid's frame: turned by one radian, so that walls along the world's axes are nothing special in it.
Eigen::Matrix3d grid_from_world() { return Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitZ()).toRotationMatrix(); }

std::vector<Triangle> triangles_of(std::span<const Mesh> meshes) {
  const Eigen::Matrix3d turn = grid_from_world();
  std::vector<Triangle> triangles;
  for (const Mesh& mesh : meshes)
    for (const Eigen::Vector3i& t : mesh.triangles)
      triangles.push_back({turn * mesh.vertices[t[0]], turn * mesh.vertices[t[1]], turn * mesh.vertices[t[2]]});
  return triangles;
}

/// 0.5 mm, a hundredth of smaller bodies, more for those that would need too much memory or too many layers. Nothing
/// for bodies that are a single point.
std::optional<double> voxel_size(std::span<const Triangle> triangles) {
  Eigen::AlignedBox3d box;
  for (const Triangle& triangle : triangles)
    for (const Eigen::Vector3d& corner : triangle) box.extend(corner);
  const double extent = box.sizes().maxCoeff();
  if (extent == 0.0) return std::nullopt;
  const auto fits = [&](double size) {
    const Eigen::Array3d voxels = box.sizes().array() / size + 6.0;  // with the empty ones of grid_around
    return voxels.prod() <= kMostVoxels && voxels.z() < kUnreached;
  };
  double size = std::min(kFinestVoxel, extent / 100.0);
  while (!fits(size)) size *= 1.02;
  return size;
}

/// Every voxel of the grid's hull.
std::vector<std::size_t> hull(const VoxelGrid& grid) {
  std::vector<std::size_t> voxels;
  for (std::size_t at = 0; at < grid.total(); ++at) {
    const Eigen::Vector3i v = grid.voxel(at);
    if (v.minCoeff() == 0 || (grid.count - v).minCoeff() == 1) voxels.push_back(at);
  }
  return voxels;
}

/// The largest set of neighbouring voxels that hold a liquid: those that it must climb to leave.
std::vector<std::size_t> largest_basin(const VoxelGrid& grid, const std::vector<std::int16_t>& spill_layer) {
  std::vector<std::uint8_t> waits(grid.total());
  for (std::size_t at = 0; at < grid.total(); ++at)
    waits[at] = spill_layer[at] != kUnreached && spill_layer[at] > grid.voxel(at).z();
  const std::size_t row = std::size_t(grid.count.x()), layer = row * std::size_t(grid.count.y());
  std::vector<std::size_t> largest;
  for (std::size_t seed = 0; seed < grid.total(); ++seed) {
    if (!waits[seed]) continue;
    waits[seed] = 0;
    std::vector<std::size_t> basin{seed};
    for (std::size_t done = 0; done < basin.size(); ++done)
      for (const std::size_t step :
           {std::size_t{1}, row, layer})  // the hull never waits, so that no step leaves the grid
        for (const std::size_t next : {basin[done] - step, basin[done] + step})
          if (waits[next]) {
            waits[next] = 0;
            basin.push_back(next);
          }
    if (basin.size() > largest.size()) largest = std::move(basin);
  }
  return largest;
}

/// Height [m] of the highest triangle at or below `top` on a vertical line.
class PlumbLine {
 public:
  PlumbLine(const VoxelGrid& grid, std::span<const Triangle> triangles)
      : grid_(grid), triangles_(triangles), by_column_(std::size_t(grid.count.x()) * std::size_t(grid.count.y())) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto [a, b, c] = triangles[t];
      const Eigen::Vector2d low = a.head<2>().cwiseMin(b.head<2>()).cwiseMin(c.head<2>());
      const Eigen::Vector2d high = a.head<2>().cwiseMax(b.head<2>()).cwiseMax(c.head<2>());
      for (int j = grid.cell(1, low.y()); j <= grid.cell(1, high.y()); ++j)
        for (int i = grid.cell(0, low.x()); i <= grid.cell(0, high.x()); ++i)
          by_column_[grid.index(i, j, 0)].push_back(t);
    }
  }

  std::optional<double> highest_below(const Eigen::Vector2d& at, double top) const {
    std::optional<double> highest;
    for (const std::size_t t : by_column_[grid_.index(grid_.cell(0, at.x()), grid_.cell(1, at.y()), 0)]) {
      const std::optional<double> z = height(triangles_[t], at);
      if (z && *z <= top && (!highest || *z > *highest)) highest = z;
    }
    return highest;
  }

 private:
  static std::optional<double> height(const Triangle& triangle, const Eigen::Vector2d& at) {
    constexpr double kInclusive = -1e-9;  // of the triangle, so that lines through edges and corners meet it
    const Eigen::Vector2d a = triangle[0].head<2>(), u = triangle[1].head<2>() - a, v = triangle[2].head<2>() - a;
    const double area = u.x() * v.y() - u.y() * v.x();
    if (area == 0.0) return std::nullopt;
    const Eigen::Vector2d p = at - a;
    const double s = (p.x() * v.y() - p.y() * v.x()) / area, t = (u.x() * p.y() - u.y() * p.x()) / area;
    if (s < kInclusive || t < kInclusive || s + t > 1.0 - kInclusive) return std::nullopt;
    return triangle[0].z() + s * (triangle[1].z() - triangle[0].z()) + t * (triangle[2].z() - triangle[0].z());
  }

  const VoxelGrid& grid_;
  std::span<const Triangle> triangles_;
  std::vector<std::vector<std::size_t>> by_column_;
};

}  // namespace

bool Cavity::label_voxels() {
  std::vector<std::uint8_t> wall = touched_voxels(grid_, triangles_);
  std::vector<std::uint8_t> passable(wall.size());
  for (std::size_t at = 0; at < wall.size(); ++at) passable[at] = !wall[at];
  const std::vector<std::int16_t> spill_layer = climb(grid_, passable, hull(grid_));
  const std::vector<std::size_t> basin = largest_basin(grid_, spill_layer);
  if (basin.empty()) return false;
  top_layer_ = spill_layer[basin.front()];
  int lowest = top_layer_;
  for (const std::size_t at : basin) lowest = std::min(lowest, grid_.voxel(at).z());
  if (top_layer_ - lowest < 2) return false;

  std::fill(passable.begin(), passable.end(), 0);
  std::vector<std::size_t> deepest;
  for (const std::size_t at : basin) {
    passable[at] = 1;
    if (grid_.voxel(at).z() == lowest) deepest.push_back(at);
  }
  labels_ = climb(grid_, passable, deepest);
  for (std::size_t at = 0; at < labels_.size(); ++at)
    if (!passable[at]) labels_[at] = wall[at] ? kWall : spill_layer[at] == kUnreached ? kSealed : kOutside;
  return true;
}

void Cavity::find_columns() {
  const PlumbLine plumb(grid_, triangles_);
  floor_ = grid_.edge(2, top_layer_);
  for (int j = 0; j < grid_.count.y(); ++j)
    for (int i = 0; i < grid_.count.x(); ++i)
      for (int k = 1; k < top_layer_; ++k) {
        const std::int16_t label = labels_[grid_.index(i, j, k)];
        if (label < 0 || labels_[grid_.index(i, j, k - 1)] != kWall) continue;
        int lowest = k - 1;
        while (labels_[grid_.index(i, j, lowest - 1)] == kWall) --lowest;
        const Eigen::Vector2d at(grid_.centre(0, i), grid_.centre(1, j));
        const std::optional<double> bottom = plumb.highest_below(at, grid_.edge(2, k));
        if (!bottom || *bottom < grid_.edge(2, lowest)) continue;  // the line passes through a crack
        // What is reached without climbing is reached from the deepest place as the liquid rises.
        columns_.push_back({at, *bottom, grid_.edge(2, k), label == k ? std::int16_t{0} : label});
        floor_ = std::min(floor_, *bottom);
      }
  // Low tops first: the lines that start far up run down along walls, which the liquid need not have climbed.
  std::stable_sort(columns_.begin(), columns_.end(), [](const Column& a, const Column& b) { return a.top < b.top; });
  // Corners below all columns: the lowest point of a vault.
  for (const Triangle& triangle : triangles_)
    for (const Eigen::Vector3d& corner : triangle) {
      if (corner.z() >= floor_ || corner.z() < floor_ - 4.0 * grid_.size) continue;
      const int i = grid_.cell(0, corner.x()), j = grid_.cell(1, corner.y());
      int k = grid_.cell(2, corner.z());
      while (k < top_layer_ && labels_[grid_.index(i, j, k)] == kWall) ++k;
      if (labels_[grid_.index(i, j, k)] < 0) continue;
      constexpr double kSame = 1e-9;  // [m]
      const std::optional<double> bottom = plumb.highest_below(corner.head<2>(), grid_.edge(2, k));
      if (bottom && std::fabs(*bottom - corner.z()) < kSame) floor_ = corner.z();
    }
}

void Cavity::find_rim() {
  const double tolerance = 2.0 * grid_.size;
  const auto leak_at = [&](double level) { return section(level, walls(level)).leak; };
  double high = grid_.edge(2, top_layer_);
  double low = high - 0.25 * grid_.size;
  rim_ = high;
  for (Leak leak; low > floor_ && (leak = leak_at(low)).width > tolerance; low -= 0.5 * grid_.size) {
    high = low;
    spill_ << leak.at, low;
  }
  if (high == rim_) {  // only the very next layer is open
    spill_ << leak_at(std::nextafter(high, 2.0 * high)).at, high;
  }
  while (high - low > 1e-9) {
    const double middle = 0.5 * (low + high);
    const Leak leak = leak_at(middle);
    (leak.width > tolerance ? high : low) = middle;
    if (leak.width > tolerance) spill_ << leak.at, middle;
  }
  rim_ = low;
  spill_ = grid_from_world().transpose() * spill_;
}

int Cavity::layer_at(double level) const { return std::clamp(grid_.cell(2, level), 0, top_layer_ - 1); }

std::vector<Segment> Cavity::walls(double level) const { return plane_section(triangles_, level, 2.0 * grid_.size); }

PlaneCells Cavity::section(double level, std::span<const Segment> walls) const {
  std::vector<InsidePoint> inside;
  for (const Column& column : columns_)
    if (column.bottom < level && level <= column.top) inside.push_back({column.at, column.layer});
  const std::size_t layer_size = grid_.index(0, 0, 1);
  const std::span<const std::int16_t> labels(labels_.data() + grid_.index(0, 0, layer_at(level)), layer_size);
  return plane_cells(grid_, labels, walls, inside);
}

Cavity::Slice Cavity::slice(double low, double high) const {
  Slice result{low, high, {}};
  const double middle = 0.5 * (low + high), offset = 0.5 * (high - low) / std::sqrt(3.0);
  for (const double level : {middle - offset, middle + offset})  // Gauss: exact where the area is cubic in height
    for (const Cell& cell : section(level, walls(level)).cells)
      if (cell.layer >= 0) result.volume_by_layer[cell.layer] += 0.5 * (high - low) * cell.area();
  return result;
}

std::vector<double> Cavity::first_levels() const {
  constexpr int kSlices = 16;
  constexpr double kSame = 1e-6;  // [m]
  std::vector<double> levels;
  for (int i = 0; i <= kSlices; ++i) levels.push_back(floor_ + depth() * i / kSlices);
  for (const auto& [a, b, c] : triangles_)
    if (a.z() == b.z() && b.z() == c.z() && a.z() > floor_ + kSame && a.z() < rim_ - kSame) levels.push_back(a.z());
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end(), [](double x, double y) { return y - x < kSame; }),
               levels.end());
  levels.back() = rim_;
  return levels;
}

void Cavity::add_slices(Slice whole) {
  // A hundred-thousandth of a cavity as wide as this slice; a step in the walls is found to 1/10 000 of the depth.
  const double tolerance = 1e-5 * depth() / (whole.high - whole.low);
  // Not in the middle: halves could hide a step as the whole does.
  const double between = 0.6 * whole.low + 0.4 * whole.high;
  Slice lower = slice(whole.low, between), upper = slice(between, whole.high);
  const auto agree = [&](int layer) {  // on what is filled when the liquid has risen to that layer
    const double parts = lower.volume(layer) + upper.volume(layer);
    return std::fabs(parts - whole.volume(layer)) <= tolerance * parts;
  };
  if ((agree(top_layer_) && agree(layer_at(whole.high))) || between - whole.low < 1e-4 * depth()) {
    slices_.push_back(std::move(lower));
    slices_.push_back(std::move(upper));
    return;
  }
  add_slices(std::move(lower));
  add_slices(std::move(upper));
}

double Cavity::Slice::volume(int layer) const {
  double sum = 0.0;
  for (const auto& [needed, share] : volume_by_layer) sum += needed <= layer ? share : 0.0;
  return sum;
}

double Cavity::volume(double level) const {
  const int layer = layer_at(level);
  double volume = 0.0;
  for (const Slice& whole : slices_) {
    if (level <= whole.low) break;
    volume += (level >= whole.high ? whole : slice(whole.low, level)).volume(layer);
  }
  return volume;
}

double Cavity::level_of(double volume_wanted) const {
  auto above = std::partition_point(slices_.begin(), slices_.end(),
                                    [&](const Slice& slice) { return volume(slice.high) < volume_wanted; });
  if (above == slices_.end()) return rim_;
  double low = above->low, high = above->high;
  while (high - low > 1e-9) {  // a nanometre
    const double middle = 0.5 * (low + high);
    (volume(middle) < volume_wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

bool Cavity::holds(const Eigen::Vector3d& point, double level) const {
  if (point.z() <= floor_ || point.z() >= level) return false;
  const Eigen::Vector2d at = (grid_from_world() * point).head<2>();
  const PlaneCells plane = section(point.z(), walls(point.z()));
  return std::any_of(plane.cells.begin(), plane.cells.end(), [&](const Cell& cell) {
    return cell.layer >= 0 && cell.layer <= layer_at(level) && cell.contains(at);
  });
}

Mesh Cavity::surface(double level) const {
  const std::vector<Segment> lines = walls(level);
  Mesh mesh = mesh_of_cells(section(level, lines).cells, layer_at(level), level);
  const int layer = layer_at(level);
  const auto open = [&](const Eigen::Vector2d& at) {
    const std::int16_t label = labels_[grid_.index(grid_.cell(0, at.x()), grid_.cell(1, at.y()), layer)];
    return label != kWall && label != kSealed;
  };
  draw_into_walls(lines, open, mesh);
  mesh.transform(Pose(grid_from_world().transpose()));
  return mesh;
}

std::optional<Cavity> find_cavity(std::span<const Mesh> meshes) {
  Cavity cavity;
  cavity.triangles_ = triangles_of(meshes);
  if (cavity.triangles_.empty()) return std::nullopt;
  const std::optional<double> size = voxel_size(cavity.triangles_);
  if (!size) return std::nullopt;
  cavity.grid_ = grid_around(cavity.triangles_, *size);
  if (!cavity.label_voxels()) return std::nullopt;
  cavity.find_columns();
  cavity.find_rim();
  const std::vector<double> levels = cavity.first_levels();
  for (std::size_t i = 1; i < levels.size(); ++i) cavity.add_slices(cavity.slice(levels[i - 1], levels[i]));
  return cavity;
}

}  // namespace fathom
