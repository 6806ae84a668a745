#include "sim/render/light.h"

#include <algorithm>
#include <cmath>

#include "sim/optics/flat_refraction.h"
#include "sim/optics/fresnel.h"
#include "sim/optics/medium.h"

namespace fathom {
namespace {

bool from_behind(const Receiver& receiver, const Eigen::Vector3d& arrival) {
  return receiver.facing && receiver.facing->dot(arrival) >= 0.0;
}

/// The straight way through one medium.
std::optional<Connection> straight(const Source& source, const Receiver& receiver) {
  const Eigen::Vector3d path = receiver.point - source.position;
  const double squared = path.squaredNorm(), length = std::sqrt(squared);
  const Eigen::Vector3d direction = path / length;
  if (from_behind(receiver, direction)) return std::nullopt;
  return Connection{direction, direction, 1.0 / squared, transmittance(extinction_of(receiver.around), length),
                    0,         false};
}

/// The way that bends once, at a level surface: exact root of Snell's law.
std::optional<Connection> through_level(const Intersector& world, const Eigen::Vector3d& source,
                                        const Receiver& receiver) {
  const Body& liquid = *receiver.around;
  const double height = source.z() - *liquid.level, depth = *liquid.level - receiver.point.z();
  if (height <= 0.0 || depth <= 0.0) return std::nullopt;
  const Eigen::Vector2d across = (receiver.point - source).head<2>();
  const double separation = across.norm();
  const FlatCrossing crossing = cross_flat_interface(height, depth, separation, 1.0, liquid.medium.n);
  const double share = separation > 0.0 ? crossing.offset / separation : 0.0;
  const Eigen::Vector3d bend(source.x() + share * across.x(), source.y() + share * across.y(), *liquid.level);
  const Eigen::Vector3d from_bend = receiver.point - bend;
  const double path_in_liquid = from_bend.norm();
  const Eigen::Vector3d arrival = from_bend / path_in_liquid;
  if (from_behind(receiver, arrival)) return std::nullopt;
  if (world.occluded(receiver.point, bend) || world.occluded(bend, source)) return std::nullopt;
  const Eigen::Vector3d direction = (bend - source).normalized();
  const double cos_above = std::min(-direction.z(), 1.0);
  const double through =
      (1.0 - fresnel_reflectance(cos_above, 1.0, liquid.medium.n)) * transmittance(liquid.extinction(), path_in_liquid);
  return Connection{direction, arrival, flat_spreading(crossing, height, depth, 1.0, liquid.medium.n),
                    through,   1,       false};
}

/// Whether a way of the same kind has been found near where a candidate leads.
bool known(const std::vector<Connection>& found, const Fan::Candidate& candidate) {
  return std::any_of(found.begin(), found.end(), [&](const Connection& way) {
    return way.crossings == candidate.seed->crossings && way.turned_over == candidate.turned_over &&
           (way.direction - candidate.direction).norm() < 2.0 * candidate.seed->spacing;
  });
}

void add_new(std::vector<Connection>& found, const std::optional<Connection>& way) {
  constexpr double kSame = 1e-7;  // [rad]
  const bool is_new = way && std::none_of(found.begin(), found.end(), [&](const Connection& other) {
                        return way->crossings == other.crossings && (way->direction - other.direction).norm() < kSame;
                      });
  if (is_new) found.push_back(*way);
}

}  // namespace

PointLight::PointLight(const Intersector& world, const Eigen::Vector3d& position, Ghosts ghosts)
    : world_(world), source_{position, world.bodies_around(position)} {
  if (world.level_liquids_only() && !source_.inside) return;
  fan_.emplace(world, source_, Event::refract);
  if (ghosts == Ghosts::sought) mirrored_fan_.emplace(world, source_, Event::reflect);
}

void PointLight::connect_each(const Receiver& receiver, const Visitor& visit) const {
  if (!fan_) {
    if (receiver.around) {
      if (const auto way = through_level(world_, source_.position, receiver)) visit(*way);
    } else if (const auto way = straight(source_, receiver)) {
      if (!world_.occluded(receiver.point, source_.position)) visit(*way);
    }
    return;
  }
  std::vector<Connection> found;
  const Eigen::Vector3d towards = (receiver.point - source_.position).normalized();
  if (!from_behind(receiver, towards))
    add_new(found, shoot(world_, source_, receiver.point, receiver.around, towards, 0));
  connect_from(*fan_, Event::refract, receiver, found);
  for (const Connection& way : found) visit(way);
}

void PointLight::connect_mirrored_each(const Receiver& receiver, const Visitor& visit) const {
  std::vector<Connection> found;
  if (mirrored_fan_) connect_from(*mirrored_fan_, Event::reflect, receiver, found);
  for (const Body& liquid : world_.geometry().bodies) {
    if (!liquid.plain || receiver.around) continue;
    const double height = source_.position.z() - *liquid.level, above = receiver.point.z() - *liquid.level;
    if (height <= 0.0 || above <= 0.0) continue;
    const Eigen::Vector3d image(receiver.point.x(), receiver.point.y(), *liquid.level - above);
    add_new(found, shoot(world_, source_, receiver.point, nullptr, (image - source_.position).normalized(), 1,
                         Event::reflect));
  }
  for (const Connection& way : found)
    if (!from_behind(receiver, way.arrival)) visit(way);
}

void PointLight::connect_from(const Fan& fan, Event first, const Receiver& receiver,
                              std::vector<Connection>& found) const {
  constexpr int kMostShots = 8;  // where light is scarce most candidates lead nowhere
  int shots = 0;
  for (const Fan::Candidate& candidate : fan.near(receiver.point, receiver.around)) {
    if (from_behind(receiver, candidate.seed->pencil.direction) || known(found, candidate)) continue;
    if (++shots > kMostShots) break;
    const auto way = shoot(world_, source_, receiver.point, receiver.around, candidate.seed->direction,
                           candidate.seed->crossings, first);
    if (way && !from_behind(receiver, way->arrival)) add_new(found, way);
  }
}

}  // namespace fathom
