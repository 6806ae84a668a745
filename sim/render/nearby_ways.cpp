#include "sim/render/nearby_ways.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/parallel.h"

namespace fathom {
namespace {

/// Values at the corners of a cell, row by row, and what lies between them.
struct Bilinear {
  std::array<Eigen::Vector3d, 4> at;

  Eigen::Vector3d operator()(double across, double down) const {
    return (1.0 - down) * ((1.0 - across) * at[0] + across * at[1]) + down * ((1.0 - across) * at[2] + across * at[3]);
  }
  /// Longest side.
  double size() const {
    return std::max({(at[1] - at[0]).norm(), (at[3] - at[2]).norm(), (at[2] - at[0]).norm(), (at[3] - at[1]).norm()});
  }
  /// Whether it changes almost as evenly as a plane.
  bool is_even() const {
    constexpr double kUneven = 0.2;
    return (at[0] - at[1] - at[2] + at[3]).norm() < kUneven * size();
  }
};

bool same_surface(const SeenPoint& a, const SeenPoint& b) {
  return a.object == b.object && a.around == b.around && a.refracted == b.refracted && !a.entered && !b.entered;
}

/// A way that some of the corners have.
struct CommonWay {
  const Connection* first;
  Eigen::Vector3d direction;  ///< times the weights of these corners
  int corners;                ///< how many have been looked at when it was last found

  bool is_like(const Connection& way) const {
    return first->crossings == way.crossings && first->mirror == way.mirror && first->turned_over == way.turned_over;
  }
};

}  // namespace

NearbyWays::NearbyWays(const PointLight& projector, Look look, int width, bool mirrored)
    : projector_(projector), look_(std::move(look)), mirrored_(mirrored), columns_((width - 1) / kApart + 2) {}

void NearbyWays::prepare(int begin, int end) {
  first_row_ = begin / kApart;
  const int rows = (end - 1) / kApart + 2 - first_row_;
  corners_ = Image<Corner>(columns_, rows);
  parallel_ranges(rows, [&](int first, int last) {
    for (int row = first; row < last; ++row)
      for (int column = 0; column < columns_; ++column)
        corners_(column, row) = corner(kApart * column, kApart * (first_row_ + row));
  });
}

NearbyWays::Corner NearbyWays::corner(double x, double y) const {
  Corner corner{look_(x, y), {}};
  if (!corner.seen || corner.seen->entered) return corner;
  const Receiver receiver{corner.seen->point, corner.seen->around, &corner.seen->normal};
  for (const Ways ways : {Ways::refracted, Ways::mirrored})
    if (ways == Ways::refracted || mirrored_)
      corner.ways[static_cast<std::size_t>(ways)] = projector_.search(ways, receiver);
  return corner;
}

std::optional<std::vector<Start>> NearbyWays::starts(Ways ways, double x, double y, const SeenPoint& seen) const {
  const int column = static_cast<int>(x) / kApart, row = static_cast<int>(y) / kApart;
  const double across = x / kApart - column, down = y / kApart - row;
  std::array<const Corner*, 4> corners;
  Bilinear points;
  for (int i = 0; i < 4; ++i) {
    corners[i] = &corners_(column + i % 2, row + i / 2 - first_row_);
    if (!corners[i]->seen || !same_surface(*corners[i]->seen, seen)) return std::nullopt;
    points.at[i] = corners[i]->seen->point;
  }
  constexpr double kOff = 0.1;
  if (!points.is_even() || (points(across, down) - seen.point).norm() > kOff * points.size()) return std::nullopt;
  std::vector<CommonWay> common;
  for (int i = 0; i < 4; ++i) {
    constexpr double kLeast = 1e-3;  // a way that one corner alone has must count where its weight is 0
    const double weight = kLeast + (i % 2 ? across : 1.0 - across) * (i / 2 ? down : 1.0 - down);
    for (const Connection& way : corners[i]->ways[static_cast<std::size_t>(ways)]) {
      CommonWay* nearest = nullptr;
      double least = 0.0;
      for (CommonWay& other : common) {
        if (other.corners == i + 1 || !other.is_like(way)) continue;
        const double apart = (other.first->direction - way.direction).squaredNorm();
        if (!nearest || apart < least) nearest = &other, least = apart;
      }
      if (nearest)
        nearest->direction += weight * way.direction, nearest->corners = i + 1;
      else
        common.push_back({&way, weight * way.direction, i + 1});
    }
  }
  std::vector<Start> starts;
  for (const CommonWay& way : common)
    starts.push_back({way.direction.normalized(), way.first->crossings, way.first->mirror});
  return starts;
}

}  // namespace fathom
