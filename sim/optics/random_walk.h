// Light in turbid media as a random walk: free flights between scatterings, and whatever bounds the medium. The same
// walk goes through layers (`fathom verify`), a cup's inside and meshes; they differ only in the space that it is
// given.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>

#include "core/rng.h"
#include "sim/optics/turbid.h"

namespace fathom {

/// A packet of light on its way.
struct Walker {
  Eigen::Vector3d position;   ///< [m]
  Eigen::Vector3d direction;  ///< unit
  double weight = 1.0;        ///< power that is left of the packet
  std::uint64_t region = 0;   ///< which of the space's media it is in
  int scatterings = 0;        ///< that lie behind it
};

/// What a walk goes through. A boundary is anything with a `distance` [m] (infinite where there is none):
///   medium(walker)          the medium that the walker is in;
///   next_boundary(walker, reach)
///                           the first boundary ahead of it; any one beyond `reach` [m] if it lies beyond;
///   meet(boundary, walker, rng, visitor)
///                           what happens there, the walker standing on it: reflects or refracts it, scatters it or
///                           lowers its weight, tells the visitor what left; false where the walk ends.
template <class Space, class Visitor>
concept WalkSpace = requires(const Space& space, Walker& walker, Rng& rng, Visitor& visitor) {
  { space.medium(walker) } -> std::convertible_to<const Turbid&>;
  { space.next_boundary(walker, 1.0).distance } -> std::convertible_to<double>;
  { space.meet(space.next_boundary(walker, 1.0), walker, rng, visitor) } -> std::same_as<bool>;
};

/// A walk with less than this share of the weight it started with plays Russian roulette. From 0.05 to 1 the time for a
/// given error differs by less than a factor of two.
inline constexpr double kRouletteShare = 0.25;

/// Russian roulette: a walk below the least weight goes on, with that weight, with a probability that leaves the
/// expected weight as it is. False when the walk ends.
inline bool survives(Walker& walker, double least_weight, Rng& rng) {
  if (walker.weight >= least_weight) return true;
  if (least_weight * rng.uniform() >= walker.weight) return false;
  walker.weight = least_weight;
  return true;
}

/// A least weight that grows with the square of the distance from a walk's start, up to eight times: where far walks
/// tell little, fewer of them go on, and each stands for more.
struct NearStart {
  double least_weight;
  Eigen::Vector3d start;  ///< [m]
  double near;            ///< [m] where it begins to grow
};
inline double least_weight_of(double least_weight, const Walker&) { return least_weight; }
inline double least_weight_of(const NearStart& from, const Walker& walker) {
  constexpr double kMost = 8.0;
  const double square = (walker.position - from.start).squaredNorm() / (from.near * from.near);
  return from.least_weight * std::clamp(square, 1.0, kMost);
}

/// Moves along the direction; absorption takes its share by Beer–Lambert. `path` may be infinite.
inline void advance(Walker& walker, const Turbid& medium, double path) {
  walker.position += path * walker.direction;
  if (medium.absorption > 0.0) walker.weight *= std::exp(-medium.absorption * path);
}

/// Walks until the light has left, is absorbed or has lost at Russian roulette. Free flights have the length of the
/// scattering alone, p(s) = μs exp(−μs s), and absorption lowers the weight along them: media that do not scatter are
/// no case of their own. `visitor.at_scattering(walker)` is called at every scattering, before the new direction is
/// drawn: with the weight that arrives there and the direction it comes from. `least_weight`, for Russian roulette, is
/// a number above 0 or NearStart.
template <class Space, class LeastWeight, class Visitor>
requires WalkSpace<Space, Visitor>
void random_walk(const Space& space, Walker walker, const LeastWeight& least_weight, Rng& rng, Visitor& visitor) {
  while (survives(walker, least_weight_of(least_weight, walker), rng)) {
    const Turbid& medium = space.medium(walker);
    // Where nothing scatters this is infinite, or NaN for a draw of exactly 0: neither is below a distance.
    const double flight = -std::log(1.0 - rng.uniform()) / medium.scattering;
    const auto boundary = space.next_boundary(walker, flight);
    if (flight < boundary.distance) {
      advance(walker, medium, flight);
      visitor.at_scattering(walker);
      walker.direction = scatter(walker.direction, medium, rng);
      ++walker.scatterings;
    } else {
      advance(walker, medium, boundary.distance);
      if (!space.meet(boundary, walker, rng, visitor)) return;
    }
  }
}

/// How a walk begins, as numbers in [0, 1). Walks that share out such numbers evenly (see even_step) tell more than
/// walks that draw them.
struct FirstStep {
  double flight;
  double cosine;
  double azimuth;
};

/// Number `i` of a sequence that fills the unit cube evenly at any length, moved around by `shift`: the multiples of
/// the powers of 1/φ, with φ⁴ = φ + 1 (Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018).
inline FirstStep even_step(int i, const FirstStep& shift) {
  const auto at = [i](double start, double step) {
    const double sum = start + i * step;
    return sum - std::floor(sum);
  };
  return {at(shift.flight, 0.8191725134), at(shift.cosine, 0.6710436067), at(shift.azimuth, 0.5497004779)};
}

/// The same expectation, for light that starts as a beam: its first flight is split into what reaches the boundary
/// unscattered and what scatters on the way, each walked with its share of the weight. In a nearly clear medium neither
/// is then left to chance. `first`: of what scatters; drawn if it is not given. `near` [m]: as in NearStart, about the
/// walker.
template <class Space, class Visitor>
requires WalkSpace<Space, Visitor>
void random_walk_of_beam(const Space& space, const Walker& walker, Rng& rng, Visitor& visitor,
                         const FirstStep* first = nullptr, double near = std::numeric_limits<double>::infinity()) {
  const Turbid& medium = space.medium(walker);
  const auto boundary = space.next_boundary(walker, std::numeric_limits<double>::infinity());
  const double scattered = medium.scattering > 0.0 ? -std::expm1(-medium.scattering * boundary.distance) : 0.0;
  if (scattered < 1.0) {
    Walker straight = walker;
    straight.weight *= 1.0 - scattered;
    advance(straight, medium, boundary.distance);
    if (space.meet(boundary, straight, rng, visitor))
      random_walk(space, straight, NearStart{kRouletteShare * walker.weight, walker.position, near}, rng, visitor);
  }
  if (scattered > 0.0) {
    Walker turned = walker;
    turned.weight *= scattered;
    advance(turned, medium, -std::log1p(-scattered * (first ? first->flight : rng.uniform())) / medium.scattering);
    visitor.at_scattering(turned);
    turned.direction = first ? scatter(turned.direction, medium, first->cosine, first->azimuth)
                             : scatter(turned.direction, medium, rng);
    ++turned.scatterings;
    random_walk(space, turned, NearStart{kRouletteShare * turned.weight, walker.position, near}, rng, visitor);
  }
}

}  // namespace fathom
