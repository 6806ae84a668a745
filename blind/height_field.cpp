#include "blind/height_field.h"

#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/rng.h"

namespace fathom::blind {
namespace {

/// Rise at an upright wall l √(2 (1 − sin θ)) (Young & Laplace), fading inwards as the linear solution in a cylinder
/// does, I₀(r/l) ≈ e^(r/l) / √(r/l).
void add_meniscus(const World& world, const Eigen::Vector2d& place, Slope& slope) {
  const double l = world.top.capillary_length, radius = world.cup.inner_radius;
  const double rise =
      std::copysign(l * std::sqrt(2.0 * (1.0 - std::sin(world.top.contact_angle))), std::cos(world.top.contact_angle));
  const double r = place.norm();
  const double z = rise * std::exp((r - radius) / l) * std::sqrt((radius + l) / (r + l));
  slope.z += z;
  if (r == 0.0) return;
  const double dr = z * (1.0 / l - 0.5 / (r + l));
  slope.dx += dr * place.x() / r;
  slope.dy += dr * place.y() / r;
}

void add_ripples(const Top& top, const Eigen::Vector2d& place, Slope& slope) {
  const double k = 2.0 * std::numbers::pi / top.ripple_length;
  // Two crossing trains, as a tapped cup shows.
  for (const Eigen::Vector2d& along : {Eigen::Vector2d(0.8, 0.6), Eigen::Vector2d(-0.6, 0.8)}) {
    const double phase = k * along.dot(place) + top.ripple_phase;
    slope.z += 0.5 * top.ripple_amplitude * std::sin(phase);
    slope.dx += 0.5 * top.ripple_amplitude * k * along.x() * std::cos(phase);
    slope.dy += 0.5 * top.ripple_amplitude * k * along.y() * std::cos(phase);
  }
}

}  // namespace

Slope liquid_top(const World& world, const Eigen::Vector2d& place) {
  const Top& top = world.top;
  Slope slope{world.cup.bottom + world.fill + top.slope_x * place.x() + top.slope_y * place.y(), top.slope_x,
              top.slope_y};
  if (std::abs(std::cos(top.contact_angle)) > 1e-12) add_meniscus(world, place, slope);
  if (top.ripple_amplitude != 0.0) add_ripples(top, place, slope);
  return slope;
}

Slope cup_bottom(const Cup& cup, const Eigen::Vector2d& place) {
  const double q = cup.dish / (cup.inner_radius * cup.inner_radius);
  return {cup.bottom - cup.dish + q * place.squaredNorm(), 2.0 * q * place.x(), 2.0 * q * place.y()};
}

bool is_foam(const World& world, const Eigen::Vector2d& place) {
  if (world.top.foam_cover <= 0.0) return false;
  constexpr double kCell = 0.006;
  const auto cell = [](double x) { return static_cast<std::int64_t>(std::floor(x / kCell)); };
  return Rng(0xf0a3, cell(place.x()), cell(place.y())).uniform() < world.top.foam_cover;
}

}  // namespace fathom::blind
