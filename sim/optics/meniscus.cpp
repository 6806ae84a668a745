#include "sim/optics/meniscus.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace fathom {
namespace {

/// x / l_c as a function of u = acosh(1/s): increasing and convex for φ < 90°.
double distance_of(double u) { return u - 2.0 * std::tanh(u); }

/// Inverse of distance_of. The start lies right of the root, from where Newton's method on a convex function converges
/// without overshooting.
double solve_distance(double x, double u_wall) {
  double u = std::fmax(x + 2.0, u_wall);
  for (int iteration = 0; iteration < 50; ++iteration) {
    const double t = std::tanh(u);
    const double step = (u - 2.0 * t - x) / (2.0 * t * t - 1.0);
    u -= step;
    if (std::fabs(step) < 1e-15 * u) break;
  }
  return u;
}

}  // namespace

Meniscus::Meniscus(double contact_angle, double capillary_length, double wall_lean)
    : capillary_length_(capillary_length) {
  assert(contact_angle > 0.0 && contact_angle < std::numbers::pi && capillary_length > 0.0);
  const double slope_angle = 0.5 * std::numbers::pi - contact_angle - wall_lean;
  assert(std::fabs(slope_angle) < 0.5 * std::numbers::pi);
  const double s = std::sin(0.5 * std::fabs(slope_angle));
  sign_ = s == 0.0 ? 0.0 : std::copysign(1.0, slope_angle);
  u_wall_ = s == 0.0 ? 0.0 : std::acosh(1.0 / s);
}

Meniscus::Point Meniscus::at(double x) const {
  if (sign_ == 0.0) return {0.0, 0.0, 0.0};
  const double u = x > 0.0 ? solve_distance(distance_of(u_wall_) + x / capillary_length_, u_wall_) : u_wall_;
  const double s = 1.0 / std::cosh(u);
  const double slope = -2.0 * s * std::tanh(u) / (1.0 - 2.0 * s * s);
  const double height = 2.0 * capillary_length_ * s;
  if (x < 0.0) return {sign_ * (height + slope * x), sign_ * slope, 0.0};
  const double curvature = height / (capillary_length_ * capillary_length_) * std::pow(1.0 + slope * slope, 1.5);
  return {sign_ * height, sign_ * slope, sign_ * curvature};
}

}  // namespace fathom
