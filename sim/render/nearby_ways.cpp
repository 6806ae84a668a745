#include "sim/render/nearby_ways.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
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

NearbyWays::NearbyWays(const PointLight& projector, std::function<Ray(double, double)> camera_ray, int width,
                       Scope scope)
    : projector_(projector), camera_ray_(std::move(camera_ray)), scope_(scope), columns_((width - 1) / kApart + 2) {}

void NearbyWays::prepare(int begin, int end) {
  first_row_ = begin / kApart;
  const int rows = (end - 1) / kApart + 2 - first_row_;
  corners_[0] = Image<Corner>(columns_, rows);
  if (scope_.images) corners_[1] = Image<Corner>(columns_, rows);
  parallel_rows(rows, [&](int row) { search_row(row); });
}

void NearbyWays::search_row(int row) {
  for (int left = 0; left < columns_; left += kPacket) {
    const int count = std::min<int>(kPacket, columns_ - left);
    std::array<Ray, kPacket> rays;
    for (int i = 0; i < count; ++i) rays[i] = camera_ray_(kApart * (left + i), kApart * (first_row_ + row));
    const Packet<SeenPoint> seen = see(projector_.world(), std::span(rays.data(), count));
    for (int i = 0; i < count; ++i) {
      const SeenPoint* at = seen.find(i);
      if (at) corners_[0](left + i, row) = corner(*at);
      if (scope_.images && (!at || at->refracted || at->entered))
        corners_[1](left + i, row) = corner(see_first_mirrored(projector_.world(), rays[i]));
    }
  }
}

NearbyWays::Corner NearbyWays::corner(const std::optional<SeenPoint>& seen) const {
  Corner corner{seen, {}};
  if (!seen || seen->entered) return corner;
  const Receiver receiver{seen->point, seen->around, &seen->normal};
  const auto search = [&](Ways ways) {
    corner.ways[static_cast<std::size_t>(ways)] = projector_.search(ways, receiver);
  };
  search(Ways::refracted);
  if (scope_.mirrored_light) search(Ways::mirrored);
  return corner;
}

std::optional<std::vector<Start>> NearbyWays::starts(Ways ways, bool in_image, double x, double y,
                                                     const SeenPoint& seen) const {
  const int column = static_cast<int>(x) / kApart, row = static_cast<int>(y) / kApart;
  const double across = x / kApart - column, down = y / kApart - row;
  std::array<const Corner*, 4> corners;
  Bilinear points;
  for (int i = 0; i < 4; ++i) {
    corners[i] = &corners_[in_image](column + i % 2, row + i / 2 - first_row_);
    if (!corners[i]->seen || !same_surface(*corners[i]->seen, seen)) return std::nullopt;
    points.at[i] = corners[i]->seen->point;
  }
  constexpr double kOff = 0.1;
  constexpr double kWidest =
      4e-3;  // [rad] as the projector sees it: twice what lies between the rays that it sends out
  const double from_projector = (seen.point - projector_.position()).norm();
  if (points.size() > kWidest * from_projector) return std::nullopt;  // in curved mirrors corners see places far apart
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
