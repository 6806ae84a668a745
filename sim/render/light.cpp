#include "sim/render/light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/optics/flat_refraction.h"
#include "sim/optics/fresnel.h"
#include "sim/optics/medium.h"

namespace fathom {
namespace {

bool from_behind(const Receiver& receiver, const Eigen::Vector3d& arrival) {
  return receiver.facing && receiver.facing->dot(arrival) >= 0.0;
}

/// A way on which nothing opaque has been looked for yet.
struct OpenWay {
  Connection connection;
  std::optional<Eigen::Vector3d> bend;  ///< where it is not straight
};

/// The straight way through one medium.
std::optional<OpenWay> straight(const Source& source, const Receiver& receiver) {
  const Eigen::Vector3d path = receiver.point - source.position;
  const double squared = path.squaredNorm(), length = std::sqrt(squared);
  const Eigen::Vector3d direction = path / length;
  if (from_behind(receiver, direction)) return std::nullopt;
  const double through = transmittance(extinction_of(receiver.around), length);
  return OpenWay{{direction, direction, 1.0 / squared, through, 0, false}, std::nullopt};
}

/// The way that bends once, at a level surface: exact root of Snell's law.
std::optional<OpenWay> through_level(const Source& source, const Receiver& receiver) {
  const Body& liquid = *receiver.around;
  const double height = source.position.z() - *liquid.level, depth = *liquid.level - receiver.point.z();
  if (height <= 0.0 || depth <= 0.0) return std::nullopt;
  const Eigen::Vector2d across = (receiver.point - source.position).head<2>();
  const double separation = across.norm();
  const FlatCrossing crossing = cross_flat_interface(height, depth, separation, 1.0, liquid.medium.n);
  const double share = separation > 0.0 ? crossing.offset / separation : 0.0;
  const Eigen::Vector3d bend(source.position.x() + share * across.x(), source.position.y() + share * across.y(),
                             *liquid.level);
  const Eigen::Vector3d from_bend = receiver.point - bend;
  const double path_in_liquid = from_bend.norm();
  const Eigen::Vector3d arrival = from_bend / path_in_liquid;
  if (from_behind(receiver, arrival)) return std::nullopt;
  const Eigen::Vector3d direction = (bend - source.position).normalized();
  const double cos_above = std::min(-direction.z(), 1.0);
  const double through =
      (1.0 - fresnel_reflectance(cos_above, 1.0, liquid.medium.n)) * transmittance(liquid.extinction(), path_in_liquid);
  return OpenWay{{direction, arrival, flat_spreading(crossing, height, depth, 1.0, liquid.medium.n), through, 1, false},
                 bend};
}

/// Where a shot led, or seemed to lead when it failed. Neighbouring seeds would lead to the same place.
struct Tried {
  int crossings, mirror;
  bool turned_over;
  Eigen::Vector3d direction;
  double around;  ///< how far [rad]

  bool covers(const Fan::Candidate& candidate) const {
    return crossings == candidate.seed->crossings && mirror == candidate.seed->mirror &&
           turned_over == candidate.turned_over && (direction - candidate.direction).norm() < around;
  }
};

}  // namespace

PointLight::PointLight(const Intersector& world, const Eigen::Vector3d& position)
    : world_(world), source_{position, world.bodies_around(position)} {
  for (const Surface& surface : world.geometry().surfaces)
    if (const auto* interface = std::get_if<Interface>(&surface.optics)) {
      const Body& body = world.geometry().bodies[interface->body];
      if (!body.plain) continue;
      Eigen::AlignedBox2d area;
      for (const Eigen::Vector3d& vertex : surface.mesh.vertices) area.extend(vertex.head<2>());
      mirrors_.push_back({*body.level, area});
    }
  if (world.level_liquids_only() && !source_.inside) return;
  fan_.emplace(world, source_, Ways::refracted);
}

void PointLight::connect_each(std::span<const Receiver> receivers, const Visitor& visit) const {
  if (!fan_) return connect_exactly(receivers, visit);
  const Packet<Connection> straight_ways = connect_straight(receivers);
  std::vector<Connection> found;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    found.clear();
    if (const Connection* way = straight_ways.find(i)) found.push_back(*way);
    connect_from(*fan_, receivers[i], found);
    for (const Connection& way : found) visit(i, way);
  }
}

Packet<Connection> PointLight::connect_straight(std::span<const Receiver> receivers) const {
  const Body* medium = medium_in(world_.geometry(), source_.inside);
  Packet<Connection> ways;
  std::array<Piece, kPacket> pieces;
  std::array<std::size_t, kPacket> of_piece;  // receivers
  std::size_t count = 0;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    if (receivers[i].around != medium) continue;
    const std::optional<OpenWay> way = straight(source_, receivers[i]);
    if (!way) continue;
    ways.set(i, way->connection);
    pieces[count] = {receivers[i].point, source_.position}, of_piece[count++] = i;
  }
  if (!count) return ways;
  const std::bitset<kPacket> interrupted = world_.interrupted(std::span(pieces).first(count));
  for (std::size_t k = 0; k < count; ++k) {
    if (!interrupted[k]) continue;
    // Boundaries within bodies may be all that is there.
    const std::size_t i = of_piece[k];
    const Eigen::Vector3d towards = ways.find(i)->direction;
    ways.reset(i);
    if (const auto way = shoot(world_, source_, receivers[i].point, medium, towards, 0)) ways.set(i, *way);
  }
  return ways;
}

void PointLight::connect_exactly(std::span<const Receiver> receivers, const Visitor& visit) const {
  std::array<OpenWay, kPacket> ways;
  std::array<std::size_t, kPacket> of_way;  // receivers
  std::array<Piece, kPacket> below, above;
  std::array<std::size_t, kPacket> of_above;  // ways
  std::size_t open = 0, bent = 0;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const std::optional<OpenWay> way =
        receivers[i].around ? through_level(source_, receivers[i]) : straight(source_, receivers[i]);
    if (!way) continue;
    below[open] = {receivers[i].point, way->bend.value_or(source_.position)};
    if (way->bend) above[bent] = {*way->bend, source_.position}, of_above[bent++] = open;
    ways[open] = *way, of_way[open++] = i;
  }
  if (!open) return;
  std::bitset<kPacket> blocked = world_.occluded(std::span(below).first(open));
  if (bent) {
    const std::bitset<kPacket> blocked_above = world_.occluded(std::span(above).first(bent));
    for (std::size_t i = 0; i < bent; ++i)
      if (blocked_above[i]) blocked.set(of_above[i]);
  }
  for (std::size_t i = 0; i < open; ++i)
    if (!blocked[i]) visit(of_way[i], ways[i].connection);
}

void PointLight::connect_mirrored_each(const Receiver& receiver, double share, Rng& rng,
                                       const std::function<void(const Connection&)>& visit) const {
  std::vector<Connection> found;
  for (const Mirror& mirror : mirrors_) {
    if (receiver.around) break;
    const double height = source_.position.z() - mirror.level, above = receiver.point.z() - mirror.level;
    if (height <= 0.0 || above <= 0.0) continue;
    const Eigen::Vector3d image(receiver.point.x(), receiver.point.y(), mirror.level - above);
    const Eigen::Vector3d towards = image - source_.position;
    const Eigen::Vector2d meeting = source_.position.head<2>() + height / (height + above) * towards.head<2>();
    if (!mirror.area.contains(meeting)) continue;
    add_new(found, shoot(world_, source_, receiver.point, nullptr, towards.normalized(), 1, 0));
  }
  const auto level_ones = static_cast<std::ptrdiff_t>(found.size());
  if (fan_) {
    std::call_once(mirrored_once_, [this] { mirrored_fan_.emplace(world_, source_, Ways::mirrored); });
    constexpr double kFaint = 0.1;  // beside the straight light
    const double straight = 1.0 / (receiver.point - source_.position).squaredNorm();
    const double chance = std::min(share * mirrored_fan_->strength_near(receiver.point) / (kFaint * straight), 1.0);
    if (chance == 1.0 || rng.uniform() < chance) connect_from(*mirrored_fan_, receiver, found);
    std::for_each(found.begin() + level_ones, found.end(), [&](Connection& way) { way.transmittance /= chance; });
  }
  for (const Connection& way : found)
    if (!from_behind(receiver, way.arrival)) visit(way);
}

void PointLight::connect_from(const Fan& fan, const Receiver& receiver, std::vector<Connection>& found) const {
  constexpr std::size_t kMostShots = 8;  // where light is scarce most candidates lead nowhere
  std::vector<Tried> tried;
  for (const Fan::Candidate& candidate : fan.near(receiver.point, receiver.around)) {
    const bool covered =
        std::any_of(tried.begin(), tried.end(), [&](const Tried& other) { return other.covers(candidate); });
    if (covered || from_behind(receiver, candidate.seed->pencil.direction)) continue;
    if (tried.size() == kMostShots) break;
    const Seed& seed = *candidate.seed;
    const auto way =
        shoot(world_, source_, receiver.point, receiver.around, seed.direction, seed.crossings, seed.mirror);
    if (way)
      tried.push_back({seed.crossings, seed.mirror, way->turned_over, way->direction, 2.0 * seed.spacing});
    else
      tried.push_back({seed.crossings, seed.mirror, candidate.turned_over, candidate.direction, 0.5 * seed.spacing});
    if (way && !from_behind(receiver, way->arrival) && way->partly_mirrored == (seed.mirror != kNoMirror))
      add_new(found, way);
  }
}

}  // namespace fathom
