#include "theory/raised_bottom.h"

#include <cmath>
#include <numbers>

#include "theory/require.h"

namespace fathom::theory {
namespace {

void require_refraction(double theta_1, double n) {
  require(theta_1 >= 0.0 && theta_1 <= std::numbers::pi / 2.0, "the incidence angle must be from 0 to 90 deg");
  require(n >= 1.0 && std::isfinite(n), "the liquid's index must be at least 1");
}

}  // namespace

double apparent_depth(double w, double theta_1, double n) {
  require(w >= 0.0 && std::isfinite(w), "the liquid's depth must not be negative");
  // tan θ2 / tan θ1 with sin θ1 = n sin θ2 put in, which is finite at θ1 = 0.
  return w * std::cos(theta_1) / (n * std::cos(refraction_angle(theta_1, n)));
}

double refraction_angle(double theta_1, double n) {
  require_refraction(theta_1, n);
  return std::asin(std::sin(theta_1) / n);
}

double raised_height(double w, double theta_1, double n) { return w - apparent_depth(w, theta_1, n); }

double incidence_angle(double p, double h) {
  require(p >= 0.0 && std::isfinite(p), "the horizontal distance must not be negative");
  require(h > 0.0 && std::isfinite(h), "the sensor must be above the bottom");
  return std::atan2(p, h);
}

double horizontal_distance(double d, double b) {
  require(std::isfinite(d), "the point's distance must be finite");
  require(b >= 0.0 && std::isfinite(b), "the baseline must not be negative");
  return std::hypot(d, b / 2.0);
}

double incidence_angle_at(double d, double b, double h) { return incidence_angle(horizontal_distance(d, b), h); }

double raised_height_at(double w, const BottomView& view) {
  return raised_height(w, incidence_angle_at(view.d, view.b, view.h), view.n);
}

std::optional<double> fill_from_height(double m, double theta_1, double n) {
  const double rise_per_depth = raised_height(1.0, theta_1, n);
  if (!(m >= 0.0) || !(rise_per_depth > 0.0) || n == 1.0) return std::nullopt;
  return m / rise_per_depth;
}

std::optional<double> fill_from_height_at(double m, const BottomView& view) {
  return fill_from_height(m, incidence_angle_at(view.d, view.b, view.h), view.n);
}

double skew_at_field_edge(double b, double fov, double range) {
  require(b >= 0.0 && std::isfinite(b), "the baseline must not be negative");
  require(fov > 0.0 && fov < std::numbers::pi, "the field of view must be between 0 and 180 deg");
  require(range > 0.0 && std::isfinite(range), "the range must be positive");
  const double theta_4 = fov / 2.0;
  const double theta_1 = std::atan2(range * std::sin(theta_4) + b, range * std::cos(theta_4));
  return theta_1 - theta_4;
}

}  // namespace fathom::theory
