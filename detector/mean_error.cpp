#include "detector/mean_error.h"

#include <algorithm>
#include <bit>
#include <climits>
#include <cmath>
#include <vector>

#include "core/median.h"
#include "detector/depth_noise.h"

namespace fathom {
namespace {

constexpr double kCell = 0.010, kReach = 1.0;  // [m] to both sides of the camera, and twice as far ahead
constexpr int kCells = 200;
constexpr int kFewestPoints = 32;

struct Cell {
  int points = 0, others = 0;
  float height_sum = 0.0f;
};

/// Row-major, x along the columns.
using Raster = std::vector<Cell>;

Raster raster_of(const Points& points) {
  constexpr float kOnDesk = 0.006f;  // m: three standard deviations of single depths at 1 m
  Raster raster(static_cast<std::size_t>(kCells) * kCells);
  for (const Eigen::Vector3f& point : points) {
    const float column = (point.x() + static_cast<float>(kReach)) / static_cast<float>(kCell);
    const float row = point.y() / static_cast<float>(kCell);
    if (!(column >= 0.0f && column < kCells && row >= 0.0f && row < kCells)) continue;
    Cell& cell = raster[static_cast<std::size_t>(row) * kCells + static_cast<std::size_t>(column)];
    const bool on_desk = std::abs(point.z()) < kOnDesk;
    (on_desk ? cell.points : cell.others) += 1;
    if (on_desk) cell.height_sum += point.z();
  }
  return raster;
}

struct Patch {
  int points;
  Eigen::Vector3d mean;  ///< [m] desk frame
};

/// `side` × `side` cells, if they are bare desk that is seen everywhere.
std::optional<Patch> patch_at(const Raster& raster, int row, int column, int side) {
  constexpr int kStray = 100;  // one point in so many is noise
  int points = 0, fewest = INT_MAX, most = 0;
  double height_sum = 0.0;
  for (int y = row; y < row + side; ++y)
    for (int x = column; x < column + side; ++x) {
      const Cell& cell = raster[static_cast<std::size_t>(y) * kCells + x];
      if (cell.others * kStray > cell.points) return std::nullopt;
      fewest = std::min(fewest, cell.points), most = std::max(most, cell.points);
      points += cell.points;
      height_sum += cell.height_sum;
    }
  if (fewest == 0 || 2 * fewest < most) return std::nullopt;
  const double half = 0.5 * side;
  return Patch{points, {(column + half) * kCell - kReach, (row + half) * kCell, height_sum / points}};
}

/// Of a height, when that of the depth at 1 m is 1: the depth's grows with the range's square, and a line of sight that
/// falls by `below` over its range turns it into one of the height.
double height_per_depth(const Eigen::Vector3d& place, double camera_height_m) {
  const double below = camera_height_m - place.z();
  return below * std::hypot(place.head<2>().norm(), below);
}

/// Error of a mean inside a cup over that of a patch of the desk, because windows of 9 × 9 pixels that hold part of a
/// wall misread what is beside it. In 320 simulated cups it was 2.0, 2.1, 1.4, 1.3 and 1.4 for means over 45, 90, 190,
/// 380 and 760 points; in 106 of the device's model it was 1.2 over all sizes.
double beside_walls(int points) {
  constexpr double kHalfWindows = 8.0, kBorder = 3.0;
  const double inner = std::max(0.0, 1.0 - kHalfWindows / std::sqrt(static_cast<double>(points)));
  return std::sqrt(1.0 + kBorder * std::pow(1.0 - inner * inner, 2));
}

}  // namespace

int MeanError::size_of(int points) {
  return std::clamp(static_cast<int>(std::bit_width(static_cast<unsigned>(points / kFewestPoints))) - 1, 0, kSizes - 1);
}

MeanError::MeanError(const Points& points, double camera_height_m) : camera_height_m_(camera_height_m) {
  constexpr int kFewestPatches = 20;  // tell a deviation within a fifth of it
  constexpr double kSigmaPerMedian = 1.4826;
  const Raster raster = raster_of(points);
  std::array<std::vector<double>, kSizes> off;
  for (const int side : {2, 3, 4, 6})
    for (int row = 0; row + side <= kCells; row += side)
      for (int column = 0; column + side <= kCells; column += side)
        if (const auto patch = patch_at(raster, row, column, side); patch && patch->points >= kFewestPoints)
          off[size_of(patch->points)].push_back(std::abs(patch->mean.z()) /
                                                height_per_depth(patch->mean, camera_height_m));
  for (int size = 0; size < kSizes; ++size)
    if (off[size].size() >= kFewestPatches) depth_error_m_[size] = kSigmaPerMedian * median(std::move(off[size]));
}

double MeanError::of_height(int points, const Eigen::Vector3d& place) const {
  constexpr double kLeast = 2e-5;  // no floor of a cup is flatter; a cloud without noise would be sure of anything
  const double scale = height_per_depth(place, camera_height_m_);
  const int size = size_of(points);
  for (int fewer = size; fewer >= 0; --fewer)
    if (depth_error_m_[fewer]) return std::max(kLeast, *depth_error_m_[fewer] * scale * beside_walls(points));
  double root = 1.0;  // errors of so few points may be independent
  for (int more = size + 1; more < kSizes; ++more) {
    root *= std::sqrt(2.0);
    if (depth_error_m_[more]) return std::max(kLeast, *depth_error_m_[more] * root * scale * beside_walls(points));
  }
  const double independent = std::max(1.0, points / kPointsPerIndependent);
  return std::hypot(depth_noise_m(1.0) / std::sqrt(independent), mean_error_m(1.0)) * scale;
}

}  // namespace fathom
