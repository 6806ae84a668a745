#include "sim/scene/liquid_top.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/scene/cup_mesh.h"

namespace fathom {
namespace {

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

LiquidTop::LiquidTop(const CupShape& shape, double level, const LiquidForm& form)
    : level_(level), gradient_(std::tan(form.tilt) * direction_of(form.tilt_azimuth)) {
  for (const Ripple& ripple : form.ripples)
    waves_.push_back(
        {2.0 * std::numbers::pi / ripple.wavelength * direction_of(ripple.azimuth), ripple.amplitude, ripple.phase});
  double contact = level;
  if (form.wetting) {
    meniscus_.emplace(form.wetting->contact_angle, form.wetting->capillary_length, shape.wall_lean(level));
    contact += meniscus_->rise();
    radius_ = shape.inner_radius(contact);
  }
  outer_ = 0.5 * (shape.inner_radius(contact) + shape.outer_radius(contact));
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

Mesh LiquidTop::mesh() const {
  const std::vector<double> radii = ring_radii(outer_, radius_, !waves_.empty(), meniscus_.has_value());
  constexpr int facets = 2 * kFacetsAround;
  Mesh mesh;
  const auto add = [&](const Eigen::Vector2d& from_axis) {
    const Eigen::Vector2d xy = axis_ + from_axis;
    return mesh.add_vertex({xy.x(), xy.y(), at(xy).z});
  };
  add(Eigen::Vector2d::Zero());
  for (const double radius : radii)
    for (int facet = 0; facet < facets; ++facet) add(radius * direction_of(2.0 * std::numbers::pi * facet / facets));
  for (int facet = 0; facet < facets; ++facet) mesh.add_triangle(0, 1 + facet, 1 + (facet + 1) % facets);
  for (int ring = 0; ring + 1 < static_cast<int>(radii.size()); ++ring)
    for (int facet = 0; facet < facets; ++facet) {
      const int next = (facet + 1) % facets, low = 1 + ring * facets, high = low + facets;
      mesh.add_triangle(low + facet, high + facet, high + next);
      mesh.add_triangle(low + facet, high + next, low + next);
    }
  return mesh;
}

}  // namespace fathom
