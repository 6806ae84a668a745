#include "detector/surface.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "detector/depth_noise.h"

namespace fathom {
namespace {

/// The middle of the shortest interval that holds half of the heights: the commonest one (Rousseeuw 1984).
double commonest(std::vector<float>& heights) {
  std::sort(heights.begin(), heights.end());
  const std::size_t half = heights.size() / 2;
  std::size_t best = 0;
  for (std::size_t i = 0; i + half < heights.size(); ++i)
    if (heights[i + half] - heights[i] < heights[best + half] - heights[best]) best = i;
  return 0.5 * (static_cast<double>(heights[best]) + heights[best + half]);
}

struct FittedPlane {
  Eigen::Vector3d mean;
  Eigen::Vector2d gradient;
  double sd;                       ///< of the points about the plane
  Eigen::Vector2d gradient_sigma;  ///< when neighbours err alike
  double height_at(const Eigen::Vector3f& point) const {
    return mean.z() + gradient.dot(point.head<2>().cast<double>() - mean.head<2>());
  }
};

FittedPlane plane_through(const Points& points) {
  FittedPlane plane{Eigen::Vector3d::Zero(), {}, 0.0, {}};
  for (const Eigen::Vector3f& point : points) plane.mean += point.cast<double>();
  plane.mean /= static_cast<double>(points.size());
  constexpr double kTiny = 1e-12;  // m²: a patch without extent has no gradient to speak of
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Identity() * kTiny;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (const Eigen::Vector3f& point : points) {
    const Eigen::Vector3d off = point.cast<double>() - plane.mean;
    scatter += off.head<2>() * off.head<2>().transpose();
    moment += off.head<2>() * off.z();
  }
  const Eigen::Matrix2d inverse = scatter.inverse();
  plane.gradient = inverse * moment;
  double squares = 0.0;
  for (const Eigen::Vector3f& point : points) squares += std::pow(point.z() - plane.height_at(point), 2);
  plane.sd = std::sqrt(squares / static_cast<double>(points.size() - 1));
  plane.gradient_sigma = (inverse.diagonal() * kPointsPerIndependent).cwiseSqrt() * plane.sd;
  return plane;
}

}  // namespace

std::optional<LevelSurface> find_surface(const Points& inside, const RoundWall& wall, double camera_height_m,
                                         const SurfaceSettings& settings) {
  Points points;
  std::vector<float> heights;
  for (const Eigen::Vector3f& point : inside) {
    if (wall.distance_of(point) > wall.radius_at(point.z()) - settings.margin_m) continue;
    points.push_back(point);
    heights.push_back(point.z());
  }
  if (static_cast<int>(points.size()) < settings.points_min) return std::nullopt;
  FittedPlane plane{{0.0, 0.0, commonest(heights)}, {0.0, 0.0}, 0.0, {}};
  Points level;
  constexpr int kRounds = 4;  // a plane that leans takes in more of its points each time
  for (int round = 0; round < kRounds; ++round) {
    level.clear();
    std::copy_if(points.begin(), points.end(), std::back_inserter(level), [&](const Eigen::Vector3f& point) {
      return std::abs(point.z() - plane.height_at(point)) <= settings.level_m;
    });
    if (static_cast<int>(level.size()) < settings.points_min) return std::nullopt;
    plane = plane_through(level);
  }
  const double share = static_cast<double>(level.size()) / static_cast<double>(points.size());
  const double tilt = std::atan(plane.gradient.norm()), tilt_sigma = std::atan(plane.gradient_sigma.norm());
  // Steep because it is a wall; a patch too small to tell counts as level.
  if (share < settings.share_min || tilt - tilt_sigma > settings.slope_max_rad) return std::nullopt;

  const double range = (plane.mean - Eigen::Vector3d(0.0, 0.0, camera_height_m)).norm();
  return LevelSurface{plane.mean, plane.sd, tilt, tilt_sigma, range, static_cast<int>(level.size())};
}

MoundSlope mound_slope(const Points& inside, const RoundWall& wall, const LevelSurface& surface,
                       const SurfaceSettings& settings) {
  constexpr double kAbout = 3.0;   // × level_m: a mound of 20° in a cup rises that much
  constexpr double kRidge = 1e-9;  // m²: without extent there is no slope to speak of
  Eigen::Matrix4d normal = Eigen::Matrix4d::Identity() * kRidge;
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  double squares = 0.0;
  int count = 0;
  for (const Eigen::Vector3f& point : inside) {
    const double distance = wall.distance_of(point), off = point.z() - surface.middle.z();
    if (distance > wall.radius_at(point.z()) - settings.margin_m || std::abs(off) > kAbout * settings.level_m) continue;
    const Eigen::Vector2d across = point.head<2>().cast<double>() - wall.center;
    const Eigen::Vector4d terms(1.0, across.x(), across.y(), -distance);
    normal += terms * terms.transpose();
    right += terms * off;
    squares += off * off;
    ++count;
  }
  const Eigen::Matrix4d inverse = normal.inverse();
  const Eigen::Vector4d fit = inverse * right;
  const double variance = std::max(0.0, squares - fit.dot(right)) / std::max(1, count - 4);
  return {std::atan(fit(3)), std::atan(std::sqrt(inverse(3, 3) * variance * kPointsPerIndependent))};
}

}  // namespace fathom
