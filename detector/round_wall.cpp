#include "detector/round_wall.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>

namespace fathom {
namespace {

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
std::optional<double> filling_height(const Points& points, const SlabCircle& circle, const WallSearch& search) {
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

std::optional<RoundWall> wall_from(const SlabCircle& circle, const Points& points, const WallSearch& search, Top top) {
  constexpr double kFillingMetres = 0.008;  // its noise, and the window in which wall and filling are matched as one
  std::optional<double> filling;
  if (top == Top::kOpen) filling = filling_height(points, circle, search);
  Points near;  // the slab's neighbours first: a lean is not known yet
  const auto between = [&](double low, double high) {
    near.clear();
    for (const Eigen::Vector3f& point : points)
      if (point.z() >= low && point.z() <= high && !(filling && std::abs(point.z() - *filling) < kFillingMetres))
        near.push_back(point);
  };
  const WallCone start{circle.center.cast<double>(), circle.radius, 0.0};
  between(circle.height - 0.03, circle.height + 0.03);
  std::optional<ConeFit> fit = fit_cone(near, start, search.tolerance_m);
  if (!fit) return std::nullopt;
  between(search.low_m, search.high_m);
  fit = fit_cone(near, fit->cone, search.tolerance_m);
  if (!fit) return std::nullopt;

  RoundWall wall{};
  static_cast<WallCone&>(wall) = fit->cone;
  wall.rms_m = fit->rms;
  wall.points = fit->points;
  wall.radius_sigma_m = std::sqrt(fit->covariance(2, 2));
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
void take_away(const SlabCircle& none, const WallSearch& search, Points& points) {
  const double reach = none.radius + 2.0 * search.tolerance_m;
  std::erase_if(points, [&](const Eigen::Vector3f& point) {
    return std::abs(point.z() - none.height) < search.slab_m && (point.head<2>() - none.center).norm() < reach;
  });
}

}  // namespace

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
      const auto circle = best_slab_circle(left, search, top, round);
      if (!circle || circle->score < search.arc_min * kDirections) break;
      const auto wall = wall_from(*circle, left, search, top);
      if (!wall || wall->arc_share < search.arc_min) {
        take_away(*circle, search, left);
        continue;
      }
      if (!is_part_of_one(*wall)) walls.push_back(*wall);
      take_away(*wall, search, left);
    }
  }
  return walls;
}

}  // namespace fathom
