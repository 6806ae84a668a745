#include "sim/render/shoot.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "sim/optics/fresnel.h"
#include "sim/optics/medium.h"

namespace fathom {
namespace {

/// A flight through all interfaces, and where it bent.
struct Trial {
  Flight flight;
  std::array<Eigen::Vector3d, kMostCrossings> bends;
  Landing landing;
  bool through_scattering = false, partly_mirrored = false;

  double miss() const { return landing.miss.norm(); }
};

struct Aim {
  const Intersector& world;
  const Source& source;
  const Eigen::Vector3d& target;
  const Body* around;
  int crossings;
  int mirror;
  Loss loss;

  std::optional<Trial> trial(const Eigen::Vector3d& direction) const {
    Trial result{{ray_differential_from(source.position, direction), source.inside, 1.0, loss}, {}, {}};
    Flight& flight = result.flight;
    for (int i = 0; i < crossings; ++i) {
      const std::optional<Crossing> next =
          next_crossing(world, {flight.differential.origin, flight.differential.direction}, flight.inside);
      if (!next) return std::nullopt;
      const double reflectance = pass(world, *next, i == mirror ? Event::reflect : Event::refract, flight);
      if (i == mirror) result.partly_mirrored = reflectance < 1.0;
      const bool left = medium_in(world.geometry(), flight.inside) != next->from;
      result.through_scattering |= left && next->from && next->from->scatters();
      result.bends[i] = next->hit.point;
    }
    if (medium_in(world.geometry(), flight.inside) != around) return std::nullopt;
    result.landing = land(flight.differential, target);
    return result;
  }

  /// Newton's method on the two angles, each step shortened until it brings the landing nearer. On its way to a target
  /// close behind an interface it may land before it.
  std::optional<Trial> solve(const Eigen::Vector3d& start, const Guess* guess) const {
    constexpr double kExact = 1e-13, kGood = 1e-10;  // [m] roundings of about 1 m; what is accepted when stuck above
    constexpr double kLongestStep = 0.05;            // [rad]
    constexpr int kMostHalvedSteps = 1;  // 5 find one way in 800 more, and take four times as many trials in vain
    std::optional<Trial> best = guess ? trial(guess->direction) : std::nullopt;
    if (!best || best->miss() >= guess->miss) best = trial(start);
    for (int iteration = 0; best && iteration < 30 && best->miss() > kExact; ++iteration) {
      const Eigen::Vector3d direction = direction_of(*best);
      const Matrix32d basis = perpendicular_to(direction);
      Eigen::Vector2d step = best->landing.jacobian.inverse() * best->landing.miss;
      if (!step.allFinite()) return std::nullopt;
      step *= std::min(1.0, kLongestStep / step.norm());
      std::optional<Trial> next;
      const int most_halvings = best->miss() > kGood ? kMostHalvedSteps : 0;
      for (int halving = 0; halving <= most_halvings; ++halving, step *= 0.5) {
        next = trial((direction + basis * step).normalized());
        if (next && next->miss() < best->miss()) break;
        next.reset();
      }
      if (!next) break;
      best = next;
    }
    if (best && (best->miss() > kGood || best->landing.distance <= 0.0)) best.reset();
    return best;
  }

  Eigen::Vector3d direction_of(const Trial& trial) const {
    const Eigen::Vector3d& through = crossings > 0 ? trial.bends[0] : target;
    return (through - source.position).normalized();
  }

  /// Whether nothing stands in the way and no further interface comes before the target.
  bool open(const Trial& trial) const {
    const Flight& flight = trial.flight;
    const auto after = next_crossing(world, {flight.differential.origin, flight.differential.direction}, flight.inside);
    if (after && after->hit.distance < trial.landing.distance - Intersector::kClearance) return false;
    Eigen::Vector3d from = target;
    for (int i = crossings - 1; i >= 0; --i) {
      if (world.occluded(from, trial.bends[i])) return false;
      from = trial.bends[i];
    }
    return !world.occluded(from, source.position);
  }
};

}  // namespace

double pass(const Intersector& world, const Crossing& crossing, Event event, Flight& flight) {
  const Hit& hit = crossing.hit;
  const double n_from = index_of(crossing.from), n_to = index_of(crossing.to);
  const double cosine = std::min(-flight.differential.direction.dot(hit.normal), 1.0);
  const double reflectance = fresnel_reflectance(cosine, n_from, n_to);  // 1 where the reflection is total
  const SurfaceFrame surface{hit.normal, world.curvature(hit)};
  flight.transmittance *= transmittance(extinction_of(crossing.from, flight.loss), hit.distance);
  advance(flight.differential, hit.point, hit.normal);
  if (event == Event::refract && refract(flight.differential, surface, n_from, n_to)) {
    flight.transmittance *= 1.0 - reflectance;
    flight.inside = crossing.beyond;
  } else {
    flight.transmittance *= reflectance;
    reflect(flight.differential, surface);
    flight.inside = crossing.before;
  }
  return reflectance;
}

std::optional<Connection> shoot(const Intersector& world, const Source& source, const Eigen::Vector3d& target,
                                const Body* around, const Eigen::Vector3d& direction, int crossings, int mirror,
                                Loss loss, const Guess* guess) {
  const Aim aim{world, source, target, around, crossings, mirror, loss};
  const std::optional<Trial> found = aim.solve(direction, guess);
  if (!found || !aim.open(*found)) return std::nullopt;
  const Flight& flight = found->flight;
  const double area = found->landing.jacobian.determinant();
  return Connection{aim.direction_of(*found),
                    flight.differential.direction,
                    1.0 / std::fabs(area),
                    flight.transmittance * transmittance(extinction_of(around, loss), found->landing.distance),
                    crossings,
                    area < 0.0,
                    found->through_scattering,
                    found->partly_mirrored,
                    static_cast<std::int8_t>(mirror)};
}

void add_new(std::vector<Connection>& found, const std::optional<Connection>& way) {
  constexpr double kSame = 1e-7;  // [rad]
  const bool is_new = way && std::none_of(found.begin(), found.end(), [&](const Connection& other) {
                        return way->crossings == other.crossings && (way->direction - other.direction).norm() < kSame;
                      });
  if (is_new) found.push_back(*way);
}

}  // namespace fathom
