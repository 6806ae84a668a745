#include "detector/mound.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "detector/depth_noise.h"

namespace fathom {

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
