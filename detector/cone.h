// An upright cone through the points of a round wall, by least squares.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "detector/cloud.h"

namespace fathom {

inline constexpr double kWallHeight = 0.045;  ///< [m] of a wall's radius and centre: the middle of the paper's band

/// radius(z) = radius_m + lean · (z − kWallHeight).
struct WallCone {
  Eigen::Vector2d center;  ///< [m] desk frame
  double radius_m;         ///< 45 mm above the desk, between the inner and the outer wall where both are seen
  double lean;             ///< change of the radius with the height; 0: upright, above 0: wider at the top

  double radius_at(double height_m) const { return radius_m + lean * (height_m - kWallHeight); }
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
