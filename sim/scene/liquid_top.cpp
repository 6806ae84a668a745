#include "sim/scene/liquid_top.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/scene/cup_mesh.h"

namespace fathom {
namespace {

Eigen::Vector2d direction_around(int facet) { return direction_of(2.0 * std::numbers::pi * facet / kLiquidFacets); }

/// Distance from the axis where a surface, followed outward, first goes into the wall [m].
double edge(const LiquidTop& top, const CupShape& shape, const Eigen::Vector2d& outward) {
  constexpr double kStep = 0.25e-3, kExact = 1e-6;  // [m]
  const auto is_in_cavity = [&](double radius) { return radius < shape.inner_radius(top.at(radius * outward).z); };
  double low = 0.0, high = kStep;
  while (is_in_cavity(high)) low = high, high += kStep;
  while (high - low > kExact) {
    const double middle = 0.5 * (low + high);
    (is_in_cavity(middle) ? low : high) = middle;
  }
  return high;
}

/// Radii of the rings from the axis outward. Chords of 0.25 mm stay within 2 µm of ripples of 0.5 mm by 10 mm; at the
/// wall, where a meniscus bends most, the rings close up. Every hit is polished onto the surface itself, so all that
/// the triangles decide is which rays graze past it.
std::vector<double> ring_radii(double outer, double wall, bool waves, bool meniscus) {
  constexpr double kStep = 0.25e-3, kFinest = 0.02e-3, kGrowth = 0.05, kReach = 0.012;  // [m], share, [m]
  std::vector<double> radii{outer};
  double radius = outer;
  if (meniscus) {
    if (wall < outer) radii.push_back(radius = wall);
    while (wall - radius < kReach && radius > kStep)
      radii.push_back(radius -= std::min(kFinest + kGrowth * (wall - radius), kStep));
  }
  if (waves)
    while (radius > kStep) radii.push_back(radius -= kStep);
  std::reverse(radii.begin(), radii.end());
  return radii;
}

}  // namespace

double contact_height(const CupShape& shape, double level, const Wetting& wetting) {
  constexpr double kExact = 1e-9;  // [m]
  const auto rises_above = [&](double height) {
    return level + meniscus_rise(wetting.contact_angle, wetting.capillary_length, shape.wall_lean(height)) > height;
  };
  double low = level - 2.0 * wetting.capillary_length, high = level + 2.0 * wetting.capillary_length;
  while (high - low > kExact) {
    const double middle = 0.5 * (low + high);
    (rises_above(middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

LiquidTop::LiquidTop(const CupShape& shape, double level, const LiquidForm& form)
    : level_(level), gradient_(std::tan(form.tilt) * direction_of(form.tilt_azimuth)) {
  for (const Ripple& ripple : form.ripples)
    waves_.push_back(
        {2.0 * std::numbers::pi / ripple.wavelength * direction_of(ripple.azimuth), ripple.amplitude, ripple.phase});
  if (form.wetting) {
    const double contact = contact_height(shape, level, *form.wetting);
    meniscus_.emplace(form.wetting->contact_angle, form.wetting->capillary_length, shape.wall_lean(contact));
    radius_ = shape.inner_radius(contact);
  }
}

LiquidTop::Height LiquidTop::at(const Eigen::Vector2d& xy) const {
  const Eigen::Vector2d p = xy - axis_;
  Height height{level_ + gradient_.dot(p), gradient_, Eigen::Matrix2d::Zero()};
  for (const Wave& wave : waves_) {
    const double argument = wave.k.dot(p) + wave.phase, sine = std::sin(argument);
    height.z += wave.amplitude * sine;
    height.gradient += wave.amplitude * std::cos(argument) * wave.k;
    height.hessian -= wave.amplitude * sine * wave.k * wave.k.transpose();
  }
  const double rho = p.norm();
  if (!meniscus_ || rho == 0.0) return height;
  const Meniscus::Point rise = meniscus_->at(radius_ - rho);
  const Eigen::Vector2d out = p / rho;
  const Eigen::Matrix2d along = out * out.transpose();
  height.z += rise.height;
  height.gradient -= rise.slope * out;
  height.hessian += rise.curvature * along - rise.slope / rho * (Eigen::Matrix2d::Identity() - along);
  return height;
}

void LiquidTop::turn_waves(double azimuth, double phase) {
  for (Wave& wave : waves_) {
    wave.k = wave.k.norm() * direction_of(azimuth);
    wave.phase = phase;
  }
}

std::vector<double> LiquidTop::rim(const CupShape& shape) const {
  constexpr double kDeepest = 0.25e-3;  // [m] along the surface into the wall, above its facets' sagitta
  std::vector<double> radii;
  for (int facet = 0; facet < kLiquidFacets; ++facet) {
    const Eigen::Vector2d outward = direction_around(facet);
    const double radius = edge(*this, shape, outward);
    const Height end = at(radius * outward);
    const double wall = shape.outer_radius(end.z) - shape.inner_radius(end.z);
    radii.push_back(radius + std::min(0.5 * wall, kDeepest) / std::hypot(1.0, end.gradient.dot(outward)));
  }
  return radii;
}

Mesh LiquidTop::mesh(const CupShape& shape) const {
  const std::vector<double> ends = rim(shape);
  const double farthest = *std::max_element(ends.begin(), ends.end());
  const std::vector<double> radii = ring_radii(farthest, radius_, !waves_.empty(), meniscus_.has_value());
  Mesh mesh;
  const auto add = [&](const Eigen::Vector2d& from_axis) {
    return mesh.add_vertex({from_axis.x(), from_axis.y(), at(from_axis).z});
  };
  add(Eigen::Vector2d::Zero());
  for (const double radius : radii)
    for (int facet = 0; facet < kLiquidFacets; ++facet) add(radius / farthest * ends[facet] * direction_around(facet));
  for (int facet = 0; facet < kLiquidFacets; ++facet) mesh.add_triangle(0, 1 + facet, 1 + (facet + 1) % kLiquidFacets);
  for (int ring = 0; ring + 1 < static_cast<int>(radii.size()); ++ring)
    for (int facet = 0; facet < kLiquidFacets; ++facet) {
      const int next = (facet + 1) % kLiquidFacets, low = 1 + ring * kLiquidFacets, high = low + kLiquidFacets;
      mesh.add_triangle(low + facet, high + facet, high + next);
      mesh.add_triangle(low + facet, high + next, low + next);
    }
  return mesh;
}

}  // namespace fathom
