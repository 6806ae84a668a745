#include "sim/optics/meniscus.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace fathom {
namespace {

/// Range and fineness of the table of u over x / l_c. Beyond it tanh u is 1 to 1e-12, and u = x + 2.
constexpr double kTableEnd = 14.0, kTableStep = 2e-3;

/// Hyperbolic functions of u > 0 by one exponential.
struct Hyperbolic {
  double tanh, sech;

  explicit Hyperbolic(double u) {
    const double e = std::exp(-u), square = e * e;
    tanh = (1.0 - square) / (1.0 + square);
    sech = 2.0 * e / (1.0 + square);
  }
};

/// x / l_c as a function of u = acosh(1/s): increasing and convex for φ < 90°.
double distance_of(double u) { return u - 2.0 * Hyperbolic(u).tanh; }

/// Inverse of distance_of. `u` lies right of the root, from where Newton's method on a convex function converges
/// without overshooting.
double solve_distance(double x, double u) {
  constexpr double kExact = 1e-9;  // the step after such a one would be some 1e-18
  for (int iteration = 0; iteration < 50; ++iteration) {
    const double t = Hyperbolic(u).tanh;
    const double step = (u - 2.0 * t - x) / (2.0 * t * t - 1.0);
    u -= step;
    if (std::fabs(step) < kExact) break;
  }
  return u;
}

}  // namespace

double meniscus_rise(double contact_angle, double capillary_length, double wall_lean) {
  constexpr double kUpright = 0.5 * std::numbers::pi;
  const double slope_angle = std::clamp(kUpright - contact_angle - wall_lean, -kUpright, kUpright);
  return 2.0 * capillary_length * std::sin(0.5 * slope_angle);
}

Meniscus::Meniscus(double contact_angle, double capillary_length, double wall_lean)
    : capillary_length_(capillary_length) {
  assert(contact_angle > 0.0 && contact_angle < std::numbers::pi && capillary_length > 0.0);
  const double slope_angle = 0.5 * std::numbers::pi - contact_angle - wall_lean;
  assert(std::fabs(slope_angle) < 0.5 * std::numbers::pi);
  const double s = std::sin(0.5 * std::fabs(slope_angle));
  sign_ = s == 0.0 ? 0.0 : std::copysign(1.0, slope_angle);
  if (s == 0.0) return;
  u_wall_ = std::acosh(1.0 / s);
  x_wall_ = distance_of(u_wall_);
  for (int i = 0; i * kTableStep <= kTableEnd; ++i) {
    const double x = x_wall_ + i * kTableStep;
    u_.push_back(solve_distance(x, std::fmax(x + 2.0, u_wall_)));
  }
}

double Meniscus::parameter_at(double x) const {
  // The table's next place lies right of the root.
  const auto next = static_cast<std::size_t>((x - x_wall_) / kTableStep) + 1;
  return solve_distance(x, next < u_.size() ? u_[next] : std::fmax(x + 2.0, u_wall_));
}

Meniscus::Point Meniscus::at(double x) const {
  if (sign_ == 0.0) return {0.0, 0.0, 0.0};
  const Hyperbolic at(x > 0.0 ? parameter_at(x_wall_ + x / capillary_length_) : u_wall_);
  const double s = at.sech;
  const double slope = -2.0 * s * at.tanh / (1.0 - 2.0 * s * s);
  const double height = 2.0 * capillary_length_ * s;
  if (x < 0.0) return {sign_ * (height + slope * x), sign_ * slope, 0.0};
  const double stretch = 1.0 + slope * slope;
  const double curvature = height / (capillary_length_ * capillary_length_) * stretch * std::sqrt(stretch);
  return {sign_ * height, sign_ * slope, sign_ * curvature};
}

}  // namespace fathom
