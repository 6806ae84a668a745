#include "sim/render/light.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/optics/flat_refraction.h"
#include "sim/optics/fresnel.h"
#include "sim/optics/medium.h"

namespace fathom {
namespace {

bool from_behind(const Receiver& receiver, const Eigen::Vector3d& arrival) {
  return receiver.facing && receiver.facing->dot(arrival) >= 0.0;
}

/// Adds the straight way to receiver `i` through one medium, and what of it is to be free of obstacles.
void add_straight(const Source& source, std::size_t i, const Receiver& receiver, Packet<Connection>& ways,
                  Packet<Piece>& pieces) {
  const Eigen::Vector3d path = receiver.point - source.position;
  const double squared = path.squaredNorm(), length = std::sqrt(squared);
  const Eigen::Vector3d direction = path / length;
  if (from_behind(receiver, direction)) return;
  const double through = transmittance(extinction_of(receiver.around, receiver.loss), length);
  ways.set(i, {direction, direction, 1.0 / squared, through, 0, false});
  pieces.set(i, {receiver.point, -direction, length});
}

/// Adds the way to receiver `i` that bends once, at a level surface, and its pieces above and below: exact root of
/// Snell's law.
void add_bent(const Source& source, std::size_t i, const Receiver& receiver, Packet<Connection>& ways,
              Packet<Piece>& above, Packet<Piece>& below) {
  const Body& liquid = *receiver.around;
  const double height = source.position.z() - *liquid.level, depth = *liquid.level - receiver.point.z();
  if (height <= 0.0 || depth <= 0.0) return;
  const Eigen::Vector2d across = (receiver.point - source.position).head<2>();
  const double separation = across.norm();
  const FlatCrossing crossing = cross_flat_interface(height, depth, separation, 1.0, liquid.medium.n);
  const double share = separation > 0.0 ? crossing.offset / separation : 0.0;
  const Eigen::Vector3d bend(source.position.x() + share * across.x(), source.position.y() + share * across.y(),
                             *liquid.level);
  const Eigen::Vector3d from_bend = receiver.point - bend;
  const double path_in_liquid = from_bend.norm();
  const Eigen::Vector3d arrival = from_bend / path_in_liquid;
  if (from_behind(receiver, arrival)) return;
  const Eigen::Vector3d to_bend = bend - source.position;
  const double path_above = to_bend.norm();
  const Eigen::Vector3d direction = to_bend / path_above;
  const double cos_above = std::min(-direction.z(), 1.0);
  const double through = (1.0 - fresnel_reflectance(cos_above, 1.0, liquid.medium.n)) *
                         transmittance(extinction_of(&liquid, receiver.loss), path_in_liquid);
  ways.set(i, {direction, arrival, flat_spreading(crossing, height, depth, 1.0, liquid.medium.n), through, 1, false});
  above.set(i, {bend, -direction, path_above});
  below.set(i, {receiver.point, -arrival, path_in_liquid});
}

/// Where a shot led, or seemed to lead when it failed. Neighbouring seeds would lead to the same place.
struct Tried {
  int crossings, mirror;
  bool turned_over;
  Eigen::Vector3d direction;
  double around;  ///< how far [rad]

  bool covers(const Fan::Candidate& candidate, const Eigen::Vector3d& candidates_direction) const {
    return crossings == candidate.seed->crossings && mirror == candidate.seed->mirror &&
           turned_over == candidate.turned_over && (direction - candidates_direction).norm() < around;
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

Packet<Connection> PointLight::connect_straight(const Packet<Receiver>& receivers) const {
  const Body* medium = medium_in(world_.geometry(), source_.inside);
  Packet<Connection> ways;
  Packet<Piece> pieces;
  for (std::size_t i = 0; i < kPacket; ++i) {
    const Receiver* receiver = receivers.find(i);
    if (receiver && receiver->around == medium) add_straight(source_, i, *receiver, ways, pieces);
  }
  const std::bitset<kPacket> interrupted = world_.interrupted(pieces);
  for (std::size_t i = 0; i < kPacket; ++i) {
    if (!interrupted[i]) continue;
    // Boundaries within bodies may be all that is there.
    const Eigen::Vector3d towards = ways.find(i)->direction;
    const Receiver& receiver = *receivers.find(i);
    ways.reset(i);
    if (const auto way = shoot(world_, source_, receiver.point, medium, towards, 0, kNoMirror, receiver.loss))
      ways.set(i, *way);
  }
  return ways;
}

Packet<Connection> PointLight::connect_exactly(const Packet<Receiver>& receivers) const {
  Packet<Connection> ways;
  Packet<Piece> above, below;
  for (std::size_t i = 0; i < kPacket; ++i) {
    const Receiver* receiver = receivers.find(i);
    if (receiver && receiver->around)
      add_bent(source_, i, *receiver, ways, above, below);
    else if (receiver)
      add_straight(source_, i, *receiver, ways, below);
  }
  ways.reset(world_.occluded(below) | world_.occluded(above));
  return ways;
}

void PointLight::connect_by_search(const Packet<Receiver>& receivers,
                                   const std::function<void(std::size_t, const Connection&)>& visit,
                                   const Starts& starts) const {
  const Packet<Connection> straight = connect_straight(receivers);
  std::vector<Connection> found;
  for (std::size_t i = 0; i < kPacket; ++i) {
    const Receiver* receiver = receivers.find(i);
    if (!receiver) continue;
    found.clear();
    if (const Connection* way = straight.find(i)) found.push_back(*way);
    const auto known = starts ? starts(i) : std::nullopt;
    if (!known || !follow(*known, *receiver, found)) connect_from(*fan_, *receiver, found);
    for (const Connection& each : found) visit(i, each);
  }
}

void PointLight::connect_level_mirrors(const Receiver& receiver, std::vector<Connection>& found) const {
  for (const Mirror& mirror : mirrors_) {
    if (receiver.around) break;
    const double height = source_.position.z() - mirror.level, above = receiver.point.z() - mirror.level;
    if (height <= 0.0 || above <= 0.0) continue;
    const Eigen::Vector3d image(receiver.point.x(), receiver.point.y(), mirror.level - above);
    const Eigen::Vector3d towards = image - source_.position;
    const Eigen::Vector2d meeting = source_.position.head<2>() + height / (height + above) * towards.head<2>();
    if (!mirror.area.contains(meeting)) continue;
    add_new(found, shoot(world_, source_, receiver.point, nullptr, towards.normalized(), 1, 0, receiver.loss));
  }
}

const Fan& PointLight::mirrored_fan() const {
  std::call_once(mirrored_once_, [this] { mirrored_fan_.emplace(world_, source_, Ways::mirrored); });
  return *mirrored_fan_;
}

void PointLight::connect_mirrored_each(const Receiver& receiver, double share, double drawn,
                                       const std::function<void(const Connection&)>& visit) const {
  std::vector<Connection> found;
  connect_level_mirrors(receiver, found);
  const auto level_ones = static_cast<std::ptrdiff_t>(found.size());
  if (fan_) {
    constexpr double kFaint = 0.05;  // beside the straight light
    const double straight = 1.0 / (receiver.point - source_.position).squaredNorm();
    const double strength = mirrored_fan().strength_near(receiver.point);
    const double chance = std::min(share * strength / (kFaint * straight), 1.0);
    if (drawn < chance) connect_from(mirrored_fan(), receiver, found);
    std::for_each(found.begin() + level_ones, found.end(), [&](Connection& way) { way.transmittance /= chance; });
  }
  for (const Connection& way : found)
    if (!from_behind(receiver, way.arrival)) visit(way);
}

std::vector<Connection> PointLight::search(Ways ways, const Receiver& receiver) const {
  std::vector<Connection> found;
  if (ways == Ways::mirrored) connect_level_mirrors(receiver, found);
  if (fan_) connect_from(ways == Ways::mirrored ? mirrored_fan() : *fan_, receiver, found);
  return found;
}

bool PointLight::follow(std::span<const Start> starts, const Receiver& receiver, std::vector<Connection>& found) const {
  const std::size_t before = found.size();
  for (const Start& start : starts) {
    const auto way = shoot(world_, source_, receiver.point, receiver.around, start.direction, start.crossings,
                           start.mirror, receiver.loss);
    const std::size_t known = found.size();
    if (way && !from_behind(receiver, way->arrival) && way->partly_mirrored == (start.mirror != kNoMirror))
      add_new(found, way);
    if (found.size() > known) continue;
    found.resize(before);
    return false;
  }
  return true;
}

void PointLight::connect_from(const Fan& fan, const Receiver& receiver, std::vector<Connection>& found) const {
  constexpr std::size_t kMostShots = 8;  // where light is scarce most candidates lead nowhere
  std::vector<Tried> tried;
  bool by_step = true;  // of the others, which come last, one is tried: few lead anywhere new
  for (const Fan::Candidate& candidate : fan.near(receiver.point, receiver.around)) {
    const Eigen::Vector3d direction = candidate.direction();
    const bool covered =
        std::any_of(tried.begin(), tried.end(), [&](const Tried& other) { return other.covers(candidate, direction); });
    if (covered || from_behind(receiver, candidate.seed->heading)) continue;
    if (tried.size() == kMostShots || (!candidate.by_step && !std::exchange(by_step, false))) break;
    const Seed& seed = *candidate.seed;
    const Guess guess{direction.normalized(), candidate.miss};
    const auto way = shoot(world_, source_, receiver.point, receiver.around, seed.direction, seed.crossings,
                           seed.mirror, receiver.loss, &guess);
    if (way)
      tried.push_back({seed.crossings, seed.mirror, way->turned_over, way->direction, 4.0 * seed.spacing});
    else
      tried.push_back({seed.crossings, seed.mirror, candidate.turned_over, direction, 0.5 * seed.spacing});
    if (way && !from_behind(receiver, way->arrival) && way->partly_mirrored == (seed.mirror != kNoMirror))
      add_new(found, way);
  }
}

}  // namespace fathom
