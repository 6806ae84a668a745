#include "sim/render/fan.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "sim/render/body_directions.h"
#include "sim/render/boxes.h"

namespace fathom {
namespace {

constexpr int kMostHalvings = 2;    ///< of the spacing, where pencils grow wider than a box
constexpr double kBeyond = 5e-3;    ///< [m] that a piece counts beyond its ends: rays beside it may be longer
constexpr double kFaintest = 1e-4;  ///< transmittance

Seed seed_of(const Flight& flight, const Eigen::Vector3d& direction, double spacing, int crossings, int mirror,
             const Body* medium, double begin, double end) {
  const RayDifferential& at = flight.differential;
  const Matrix32d across = perpendicular_to(at.direction);
  const Eigen::Vector3d squared_width(at.d_origin.squaredNorm(), 2.0 * at.d_origin.cwiseProduct(at.d_direction).sum(),
                                      at.d_direction.squaredNorm());
  return {medium,
          begin,
          end,
          at.origin,
          at.direction,
          spacing * spacing * squared_width,
          across,
          across.transpose() * at.d_origin,
          across.transpose() * at.d_direction,
          spacing,
          direction,
          flight.transmittance,
          crossings,
          mirror};
}

double squared_reach_of(const Seed& seed, double distance) {
  const Eigen::Vector3d& of = seed.squared_reach;
  return std::max(of[0] + distance * (of[1] + distance * of[2]), 0.0);
}

}  // namespace

double Seed::reach(double distance) const { return std::sqrt(squared_reach_of(*this, distance)); }

Eigen::Matrix2d Seed::jacobian_at(double distance) const { return jacobian + distance * jacobian_per_m; }

Fan::Fan(const Intersector& world, const Source& source, Ways ways) : ways_(ways) {
  for (const DirectionCell& cell : directions_to_bodies(world.geometry(), source.position))
    send(world, source, cell.middle, kDirectionSpacing, 0);
  for (std::uint32_t seed = 0; seed < seeds_.size(); ++seed) file(seed);
}

void Fan::send(const Intersector& world, const Source& source, const Eigen::Vector3d& direction, double spacing,
               int halvings) {
  const std::size_t sent = seeds_.size();
  const Flight flight{ray_differential_from(source.position, direction), source.inside, 1.0,
                      Loss::without_peak};  // ways that walks would miss are kept
  const bool too_wide = follow(world, flight, direction, spacing, 0, kNoMirror);
  if (!too_wide || halvings == kMostHalvings) return;
  seeds_.resize(sent);
  const Matrix32d basis = perpendicular_to(direction);
  for (const double a : {-0.25, 0.25})
    for (const double b : {-0.25, 0.25})
      send(world, source, (direction + basis * Eigen::Vector2d(a, b) * spacing).normalized(), 0.5 * spacing,
           halvings + 1);
}

bool Fan::follow(const Intersector& world, Flight flight, const Eigen::Vector3d& direction, double spacing,
                 int crossings, int mirror) {
  bool too_wide = false;
  for (; crossings <= kLongestChain && flight.transmittance > kFaintest; ++crossings) {
    const Ray ray{flight.differential.origin, flight.differential.direction};
    const std::optional<Crossing> next = next_crossing(world, ray, flight.inside);
    const std::optional<Hit> opaque = world.first_opaque(ray);
    const double open = opaque ? opaque->distance : std::numeric_limits<double>::infinity();
    const bool ends = !next || open < next->hit.distance;
    const Body* medium = medium_in(world.geometry(), flight.inside);
    const bool asked_for = ways_ == Ways::refracted ? crossings > 0 : mirror != kNoMirror;
    // In air only surfaces receive light; in a body any place may scatter it.
    if (asked_for && (medium || ends) && (std::isfinite(open) || next)) {
      const double end = ends ? open : next->hit.distance;
      seeds_.push_back(seed_of(flight, direction, spacing, crossings, mirror, medium, medium ? 0.0 : end, end));
      too_wide = too_wide || seeds_.back().reach(end) > kBox;
    }
    if (ends) break;
    if (ways_ == Ways::mirrored && mirror == kNoMirror) {
      Flight mirrored = flight;
      const bool in_part = pass(world, *next, Event::reflect, mirrored) < 1.0;
      if (in_part && follow(world, mirrored, direction, spacing, crossings + 1, crossings)) too_wide = true;
    }
    pass(world, *next, Event::refract, flight);
  }
  return too_wide;
}

void Fan::file(std::uint32_t number) {
  const Seed& seed = seeds_[number];
  const double begin = seed.begin - kBeyond, length = seed.end + kBeyond - begin;
  const int steps = static_cast<int>(std::ceil(length / kBox));
  for (int step = 0; step <= steps; ++step) {
    const double distance = begin + length * step / steps;
    const Eigen::Vector3d middle = seed.origin + distance * seed.heading;
    const double strength = seed.transmittance / std::fabs(seed.jacobian_at(distance).determinant());
    const double around = std::clamp(2.0 * seed.reach(distance), 0.5 * kBox, kBox);
    for_each_box(middle, around, [&](std::uint64_t key) {
      Box& box = boxes_[key];
      if (box.seeds.empty() || box.seeds.back() != number) box.seeds.push_back(number);  // steps share most boxes
      box.strength = std::max(box.strength, strength);
    });
  }
}

std::vector<Fan::Candidate> Fan::near(const Eigen::Vector3d& target, const Body* around) const {
  constexpr double kMostSteps = 2.5;
  std::vector<Candidate> candidates;
  const Box* box = box_near(target);
  if (!box) return candidates;
  for (const std::uint32_t number : box->seeds) {
    const Seed& seed = seeds_[number];
    if (seed.medium != around) continue;
    const Eigen::Vector3d offset = target - seed.origin;
    const double distance = offset.dot(seed.heading);
    if (distance < seed.begin - kBeyond || distance > seed.end + kBeyond) continue;
    const double squared_reach = squared_reach_of(seed, distance);
    if (offset.squaredNorm() - distance * distance > kMostSteps * kMostSteps * squared_reach) continue;
    const Eigen::Vector2d miss = seed.across.transpose() * offset;
    const Eigen::Matrix2d jacobian = seed.jacobian_at(distance);
    const double determinant = jacobian.determinant();
    Eigen::Vector2d step = jacobian.inverse() * miss;
    double steps = step.norm() / seed.spacing;
    // Near a caustic the landing is far from linear: a small miss is as good as a short step.
    const bool by_step = steps < kMostSteps;
    if (!by_step) {
      if (miss.squaredNorm() > 0.7 * 0.7 * squared_reach) continue;
      step.setZero(), steps = kMostSteps;
    }
    candidates.push_back({&seed, steps, miss.norm(), step, by_step, determinant < 0.0});
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tuple(a.steps, a.miss, a.seed) < std::tuple(b.steps, b.miss, b.seed);
  });
  return candidates;
}

double Fan::strength_near(const Eigen::Vector3d& target) const {
  const Box* box = box_near(target);
  return box ? box->strength : 0.0;
}

const Fan::Box* Fan::box_near(const Eigen::Vector3d& point) const {
  const auto box = boxes_.find(box_around(point));
  return box == boxes_.end() ? nullptr : &box->second;
}

}  // namespace fathom
