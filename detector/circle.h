// A circle through points of the desk plane by linear least squares. Paper, section V-D.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace fathom {

struct Circle {
  Eigen::Vector2d center;  ///< [m]
  double radius_m;
  double rms_m;  ///< of the points' distances from the circle
};

/// Minimises Σ(|p|² − 2 c·p − k)² over centre c and k = r² − |c|², which is linear in both (Kåsa 1976). Exact for
/// points on a circle; on short noisy arcs the radius comes out too small. Nothing for fewer than three points or
/// points on a line.
std::optional<Circle> fit_circle(const std::vector<Eigen::Vector2d>& points);

}  // namespace fathom
