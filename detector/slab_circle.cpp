#include "detector/slab_circle.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/rng.h"

namespace fathom {
namespace {

struct FlatCircle {
  Eigen::Vector2f center;
  float radius;
};

/// A thin layer of the segment and what stands over it, both thinned to a number that is quick to look through.
struct Slab {
  float height;                         ///< of its middle
  std::vector<Eigen::Vector2f> points;  ///< each stands for `each` of the segment's
  float each;
  std::vector<Eigen::Vector2f> above;
  float each_above;
};

/// Every k-th, at most `most`; returns how many each one stands for.
float thin(std::vector<Eigen::Vector2f>& points, std::size_t most) {
  if (points.size() <= most) return 1.0f;
  std::vector<Eigen::Vector2f> drawn(most);
  for (std::size_t i = 0; i < most; ++i) drawn[i] = points[i * points.size() / most];
  const float each = static_cast<float>(points.size()) / static_cast<float>(most);
  points = std::move(drawn);
  return each;
}

std::vector<Slab> slabs_of(const Points& segment, const WallSearch& search) {
  const int count = static_cast<int>(std::ceil((search.high_m - search.low_m) / search.slab_m));
  std::vector<Slab> slabs(count);
  std::vector<Eigen::Vector2f> over_all;
  for (int i = 0; i < count; ++i) slabs[i].height = static_cast<float>(search.low_m + (i + 0.5) * search.slab_m);
  for (const Eigen::Vector3f& point : segment) {
    const int i = static_cast<int>(std::floor((point.z() - search.low_m) / search.slab_m));
    if (i >= 0) (i < count ? slabs[i].points : over_all).push_back(point.head<2>());
  }
  const auto most = static_cast<std::size_t>(search.slab_points);
  for (int i = count - 1; i >= 0; --i) {
    slabs[i].above = over_all;
    over_all.insert(over_all.end(), slabs[i].points.begin(), slabs[i].points.end());
    slabs[i].each = thin(slabs[i].points, most);
    slabs[i].each_above = thin(slabs[i].above, most);
  }
  return slabs;
}

std::optional<FlatCircle> circle_through(const Eigen::Vector2f& a, const Eigen::Vector2f& b, const Eigen::Vector2f& c) {
  const Eigen::Vector2f u = b - a, v = c - a;
  const float twice_area = u.x() * v.y() - u.y() * v.x();
  constexpr float kSmallest = 2e-5f;  // m²: triangles of a few millimetres fix no circle
  if (!(std::abs(twice_area) > kSmallest)) return std::nullopt;
  const float uu = u.squaredNorm(), vv = v.squaredNorm();
  const Eigen::Vector2f offset =
      Eigen::Vector2f(v.y() * uu - u.y() * vv, u.x() * vv - v.x() * uu) / (2.0f * twice_area);
  return FlatCircle{a + offset, offset.norm()};
}

/// The number of directions in which points lie on the circle, times their share of all points on it, inside it, close
/// around it and, of a wall that is open at the top, above it. A wall has no points inside at its own height, few close
/// around it and, open at the top, none above; a circle on a can's lid has them everywhere.
float score(const Slab& slab, const FlatCircle& circle, float tolerance, Top top) {
  const float inner = circle.radius - tolerance, outer = circle.radius + tolerance;
  const float within = std::max(0.0f, circle.radius - 2.0f * tolerance), around = circle.radius + 3.0f * tolerance;
  unsigned directions = 0;
  int on = 0, inside = 0, outside = 0, above = 0;
  for (const Eigen::Vector2f& point : slab.points) {
    const Eigen::Vector2f v = point - circle.center;
    const float squared = v.squaredNorm();
    if (squared > outer * outer) {
      outside += squared < around * around;
    } else if (squared > inner * inner) {
      directions |= direction_bit(v);
      ++on;
    } else if (squared < within * within) {
      ++inside;
    }
  }
  if (on == 0) return 0.0f;
  if (top == Top::kOpen)
    for (const Eigen::Vector2f& point : slab.above) above += (point - circle.center).squaredNorm() < within * within;
  const float wall = slab.each * static_cast<float>(on);
  const float others = slab.each * static_cast<float>(inside + outside) + slab.each_above * static_cast<float>(above);
  return static_cast<float>(std::popcount(directions)) * wall / (wall + others);
}

}  // namespace

std::optional<SlabCircle> best_slab_circle(const Points& segment, const WallSearch& search, Top top, int round) {
  const std::vector<Slab> slabs = slabs_of(segment, search);
  const float tolerance = static_cast<float>(search.tolerance_m);
  const float low = static_cast<float>(search.radius_min_m), high = static_cast<float>(search.radius_max_m);
  constexpr std::size_t kFewest = 8;  // points of a slab that may show a circle
  std::vector<const Slab*> usable;
  for (const Slab& slab : slabs)
    if (slab.points.size() >= kFewest) usable.push_back(&slab);
  if (usable.empty()) return std::nullopt;

  Rng rng(1, round);
  std::optional<SlabCircle> best;
  for (int i = 0; i < search.hypotheses; ++i) {
    const Slab& slab = *usable[i % usable.size()];
    const auto any = [&]() -> const Eigen::Vector2f& {
      return slab.points[rng.below(static_cast<std::uint32_t>(slab.points.size()))];
    };
    const Eigen::Vector2f& a = any();
    const auto near_a = [&]() -> const Eigen::Vector2f& {
      constexpr int kTries = 8;
      const Eigen::Vector2f* point = &any();
      for (int k = 0; k < kTries && (*point - a).squaredNorm() > 4.0f * high * high; ++k) point = &any();
      return *point;
    };
    const auto circle = circle_through(a, near_a(), near_a());
    if (!circle || circle->radius < low || circle->radius > high) continue;
    const float worth = score(slab, *circle, tolerance, top);
    if (!best || worth > best->score) best = SlabCircle{circle->center, circle->radius, slab.height, worth};
  }
  return best;
}

}  // namespace fathom
