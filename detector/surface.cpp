#include "detector/surface.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "detector/noise.h"

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

struct Slope {
  Eigen::Vector2d gradient;
  Eigen::Vector2d sigma;
};

/// Of the plane through the points, with its error when neighbours err alike.
Slope slope_of(const Points& points, const Eigen::Vector3d& mean, double sd_m) {
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Identity() * 1e-12;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (const Eigen::Vector3f& point : points) {
    const Eigen::Vector3d off = point.cast<double>() - mean;
    scatter += off.head<2>() * off.head<2>().transpose();
    moment += off.head<2>() * off.z();
  }
  const Eigen::Matrix2d inverse = scatter.inverse();
  return {inverse * moment, (inverse.diagonal() * kPointsPerIndependent).cwiseSqrt() * sd_m};
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
  const auto all = points.size();
  if (static_cast<int>(all) < settings.points_min) return std::nullopt;
  const double level = commonest(heights);
  std::erase_if(points, [&](const Eigen::Vector3f& p) { return std::abs(p.z() - level) > settings.level_m; });
  const double share = static_cast<double>(points.size()) / static_cast<double>(all);
  if (static_cast<int>(points.size()) < settings.points_min || share < settings.share_min) return std::nullopt;

  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3f& point : points) mean += point.cast<double>();
  mean /= static_cast<double>(points.size());
  double squares = 0.0;
  for (const Eigen::Vector3f& point : points) squares += std::pow(point.z() - mean.z(), 2);
  const double sd = std::sqrt(squares / static_cast<double>(points.size() - 1));
  const Slope slope = slope_of(points, mean, sd);
  const double below = camera_height_m - mean.z(), along = mean.head<2>().norm();
  return LevelSurface{mean.z(),
                      sd,
                      std::atan(slope.gradient.norm()),
                      slope.sigma.norm(),
                      std::atan2(along, below),
                      std::hypot(along, below),
                      static_cast<int>(points.size()),
                      share};
}

}  // namespace fathom
