#include "detector/round_wall.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

#include "core/rng.h"
#include "detector/noise.h"

namespace fathom {
namespace {

enum class Top { kOpen, kAny };

constexpr int kDirections = 32;
constexpr double kLeanSigma = 0.15;  // cups lean 0 to 10°; where the points span no height, this decides

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

/// One of 32 equal directions, in no order: octants, and in each three bounds.
unsigned direction_bit(const Eigen::Vector2f& v) {
  const float x = std::abs(v.x()), y = std::abs(v.y()), small = std::min(x, y), large = std::max(x, y);
  const unsigned octant = (v.x() < 0.0f) | (v.y() < 0.0f) << 1 | (y > x) << 2;
  const unsigned part = (small > 0.19891f * large) + (small > 0.41421f * large) + (small > 0.66818f * large);
  return 1u << (octant << 2 | part);
}

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

/// Directions in which points lie on the circle, fewer for points inside it and around it. A wall has none inside at
/// its own height, and around it only what touches it, where a circle on a can's lid has them everywhere; one that is
/// open at the top has none higher up.
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

struct Hypothesis {
  FlatCircle circle;
  float height;
  float score;
};

std::optional<Hypothesis> best_circle(const std::vector<Slab>& slabs, const WallSearch& search, Top top, int round) {
  const float tolerance = static_cast<float>(search.tolerance_m);
  const float low = static_cast<float>(search.radius_min_m), high = static_cast<float>(search.radius_max_m);
  constexpr std::size_t kFewest = 8;  // points of a slab that may show a circle
  std::vector<const Slab*> usable;
  for (const Slab& slab : slabs)
    if (slab.points.size() >= kFewest) usable.push_back(&slab);
  if (usable.empty()) return std::nullopt;

  Rng rng(1, round);
  std::optional<Hypothesis> best;
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
    if (!best || worth > best->score) best = Hypothesis{*circle, slab.height, worth};
  }
  return best;
}

struct Cone {
  Eigen::Vector2d center;
  double radius, lean;

  double radius_at(double height) const { return radius + lean * (height - kWallHeight); }
};

struct ConeFit {
  Cone cone;
  Eigen::Matrix4d covariance;
  double rms;
  int points;
};

/// Gauss–Newton on the distances of the points within the tolerance of the cone, from near the truth.
std::optional<ConeFit> fit_cone(const Points& points, Cone cone, double tolerance_m) {
  ConeFit fit{};
  constexpr int kSteps = 6;  // each halves the tolerance's share of outliers; the fit itself needs three
  for (int step = 0; step < kSteps; ++step) {
    // A slab's circle knows no lean: the first step lets in what a lean of 10° puts 30 mm above and below.
    const double within = step == 0 ? 2.0 * tolerance_m : tolerance_m;
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    double squares = 0.0;
    int count = 0;
    for (const Eigen::Vector3f& point : points) {
      const Eigen::Vector2d v = point.head<2>().cast<double>() - cone.center;
      const double distance = v.norm(), above = point.z() - kWallHeight;
      const double off = distance - cone.radius_at(point.z());
      if (std::abs(off) > within || distance == 0.0) continue;
      const Eigen::Vector4d slope(-v.x() / distance, -v.y() / distance, -1.0, -above);
      normal += slope * slope.transpose();
      right += slope * off;
      squares += off * off;
      ++count;
    }
    if (count < 8) return std::nullopt;
    const double variance = std::max(squares / count, 1e-10);
    const double upright = variance * kPointsPerIndependent / (kLeanSigma * kLeanSigma);
    normal(3, 3) += upright;
    right(3) += upright * cone.lean;
    const Eigen::LDLT<Eigen::Matrix4d> solver(normal);
    if (solver.info() != Eigen::Success || !(solver.rcond() > 1e-12)) return std::nullopt;
    const Eigen::Vector4d change = solver.solve(-right);
    cone.center += change.head<2>();
    cone.radius += change(2);
    cone.lean += change(3);
    if (!(cone.radius > 0.0) || !cone.center.allFinite()) return std::nullopt;
    fit = {cone, solver.solve(Eigen::Matrix4d::Identity()) * variance * kPointsPerIndependent, std::sqrt(variance),
           count};
  }
  return fit;
}

/// The rim: in each direction the height that one point in twenty on the wall passes; the directions of a rim agree, in
/// others it is hidden, or something tall reaches over the circle. Of those that agree the upper third.
double rim_height(const Points& on_wall, const Eigen::Vector2d& center) {
  std::array<std::vector<float>, kDirections> heights;
  for (const Eigen::Vector3f& point : on_wall) {
    const unsigned bit = direction_bit(point.head<2>() - center.cast<float>());
    heights[std::countr_zero(bit)].push_back(point.z());
  }
  std::vector<float> tops;
  for (std::vector<float>& part : heights) {
    if (part.empty()) continue;
    const auto high = part.begin() + static_cast<std::ptrdiff_t>(part.size() * 19 / 20);
    std::nth_element(part.begin(), high, part.end());
    tops.push_back(*high);
  }
  std::sort(tops.begin(), tops.end());
  constexpr float kAlike = 0.006f;  // m: noise, and a rim that the desk's plane leaves a bit askew
  std::size_t first = 0, agree = 0;
  for (std::size_t low = 0, high = 0; high < tops.size(); ++high) {
    while (tops[high] - tops[low] > kAlike) ++low;
    if (high - low + 1 >= agree) first = low, agree = high - low + 1;
  }
  return tops[first + agree * 2 / 3];
}

/// The height at which the most points lie inside the circle, if many do: a filling, whose edge a leaning cone would
/// take for its wall.
std::optional<double> filling_height(const Points& points, const FlatCircle& circle, const WallSearch& search) {
  constexpr double kStep = 0.002;
  constexpr int kFewest = 40;  // of a level surface, within two steps
  std::vector<int> counts(static_cast<std::size_t>((search.high_m - search.low_m) / kStep) + 2, 0);
  const double within = circle.radius - 3.0 * search.tolerance_m;
  for (const Eigen::Vector3f& point : points) {
    if (!(point.z() > search.low_m && point.z() < search.high_m)) continue;
    if ((point.head<2>() - circle.center).norm() < within)
      ++counts[static_cast<std::size_t>((point.z() - search.low_m) / kStep)];
  }
  const auto most = std::max_element(counts.begin(), counts.end());
  if (*most < kFewest) return std::nullopt;
  return search.low_m + (static_cast<double>(most - counts.begin()) + 0.5) * kStep;
}

std::optional<RoundWall> wall_from(const Hypothesis& hypothesis, const Points& points, const WallSearch& search,
                                   Top top) {
  constexpr double kFillingMetres = 0.008;  // its noise, and the window in which wall and filling are matched as one
  std::optional<double> filling;
  if (top == Top::kOpen) filling = filling_height(points, hypothesis.circle, search);
  Points near;  // the slab's neighbours first: a lean is not known yet
  const auto between = [&](double low, double high) {
    near.clear();
    for (const Eigen::Vector3f& point : points)
      if (point.z() >= low && point.z() <= high && !(filling && std::abs(point.z() - *filling) < kFillingMetres))
        near.push_back(point);
  };
  const Cone start{hypothesis.circle.center.cast<double>(), hypothesis.circle.radius, 0.0};
  between(hypothesis.height - 0.03, hypothesis.height + 0.03);
  std::optional<ConeFit> fit = fit_cone(near, start, search.tolerance_m);
  if (!fit) return std::nullopt;
  between(search.low_m, search.high_m);
  fit = fit_cone(near, fit->cone, search.tolerance_m);
  if (!fit) return std::nullopt;

  RoundWall wall{};
  wall.center = fit->cone.center;
  wall.radius_m = fit->cone.radius;
  wall.lean = fit->cone.lean;
  wall.rms_m = fit->rms;
  wall.points = fit->points;
  wall.radius_sigma_m = std::sqrt(fit->covariance(2, 2));
  wall.center_sigma_m = std::sqrt(fit->covariance(0, 0) + fit->covariance(1, 1));
  Points on_wall;
  unsigned directions = 0;
  wall.low_m = search.high_m;
  for (const Eigen::Vector3f& point : points) {
    if (std::abs(wall.distance_of(point) - wall.radius_at(point.z())) > search.tolerance_m) continue;
    on_wall.push_back(point);
    directions |= direction_bit(point.head<2>() - wall.center.cast<float>());
    wall.low_m = std::min<double>(wall.low_m, point.z());
  }
  if (on_wall.empty()) return std::nullopt;
  wall.arc_share = static_cast<double>(std::popcount(directions)) / kDirections;
  wall.top_m = rim_height(on_wall, wall.center);
  return wall;
}

/// The wall's points and those inside it. Above its rim a wall that leans would take in its neighbours'.
void take_away(const RoundWall& wall, const WallSearch& search, Points& points) {
  std::erase_if(points, [&](const Eigen::Vector3f& point) {
    return wall.distance_of(point) < wall.radius_at(std::min<double>(point.z(), wall.top_m)) + 2.0 * search.tolerance_m;
  });
}

/// What looked like a wall in its slab and is none.
void take_away(const Hypothesis& none, const WallSearch& search, Points& points) {
  const double reach = none.circle.radius + 2.0 * search.tolerance_m;
  std::erase_if(points, [&](const Eigen::Vector3f& point) {
    return std::abs(point.z() - none.height) < search.slab_m && (point.head<2>() - none.circle.center).norm() < reach;
  });
}

}  // namespace

double RoundWall::radius_at(double height_m) const { return radius_m + lean * (height_m - kWallHeight); }

double RoundWall::distance_of(const Eigen::Vector3f& point) const {
  return (point.head<2>().cast<double>() - center).norm();
}

std::vector<RoundWall> find_round_walls(const Points& segment, const WallSearch& search) {
  std::vector<RoundWall> walls;
  const auto is_part_of_one = [&](const RoundWall& wall) {  // a thick rim, or the ends of two handles
    return std::any_of(walls.begin(), walls.end(), [&](const RoundWall& found) {
      return (wall.center - found.center).norm() < 0.5 * found.radius_m;
    });
  };
  Points left = segment;
  for (const Top top : {Top::kOpen, Top::kAny}) {
    if (top == Top::kAny && !walls.empty()) break;
    // Of what is closed one wall is enough: it is no cup, and boxes show several.
    const std::size_t most = top == Top::kOpen ? search.walls_max : 1;
    for (int round = 0; round < search.rounds_max && walls.size() < most; ++round) {
      const auto hypothesis = best_circle(slabs_of(left, search), search, top, round);
      if (!hypothesis || hypothesis->score < search.arc_min * kDirections) break;
      const auto wall = wall_from(*hypothesis, left, search, top);
      if (!wall || wall->arc_share < search.arc_min) {
        take_away(*hypothesis, search, left);
        continue;
      }
      if (!is_part_of_one(*wall)) walls.push_back(*wall);
      take_away(*wall, search, left);
    }
  }
  return walls;
}

}  // namespace fathom
