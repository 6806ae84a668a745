// An upright cone through the points of a round wall, by least squares.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "detector/cloud.h"

namespace fathom {

inline constexpr double kWallHeight = 0.045;  ///< [m] of a wall's radius and centre: the middle of the paper's band

/// radius(z) = radius + lean · (z − kWallHeight).
struct WallCone {
  Eigen::Vector2d center;
  double radius, lean;

  double radius_at(double height) const { return radius + lean * (height - kWallHeight); }
};

struct ConeFit {
  WallCone cone;
  Eigen::Matrix4d covariance;  ///< of the centre, the radius and the lean, with neighbours' errors alike
  double rms;
  int points;
};

/// Gauss–Newton on the distances of the points within the tolerance of the cone, from near the truth. Nothing when they
/// are too few or fix no cone.
std::optional<ConeFit> fit_cone(const Points& points, WallCone cone, double tolerance_m);

}  // namespace fathom
