// Rays against the scene's surfaces. Embree finds the triangle in float; the point is computed again in double, on the
// triangle's plane or on the smooth surface that it stands for.
#pragma once

#include <Eigen/Core>
#include <array>
#include <bitset>
#include <memory>
#include <optional>
#include <span>

#include "core/pose.h"
#include "sim/scene/geometry.h"

namespace fathom {

struct Hit {
  double distance;         ///< [m] along the ray
  Eigen::Vector3d point;   ///< [m] world
  Eigen::Vector3d normal;  ///< unit, of the surface, on the side the ray came from
  const Surface* surface;
  unsigned triangle;  ///< of the surface's mesh
  bool entering;      ///< whether the ray goes to the inner side
};

/// So many rays are traced together: side by side they cost Embree a third of what each costs alone.
inline constexpr std::size_t kPacket = 8;

/// Values of the rays of a packet, some of which have none. No array of std::optional: the compiler fills that with
/// zeros, which takes a tenth of the tracing's time.
template <class T>
class Packet {
 public:
  /// nullptr where there is none.
  const T* find(std::size_t i) const { return present_[i] ? &values_[i] : nullptr; }
  void set(std::size_t i, const T& value) {
    values_[i] = value;
    present_.set(i);
  }
  void reset(std::size_t i) { present_.reset(i); }
  void reset(const std::bitset<kPacket>& which) { present_ &= ~which; }
  /// Whether there are two or more.
  bool is_several() const { return (present_.to_ulong() & (present_.to_ulong() - 1)) != 0; }

 private:
  std::array<T, kPacket> values_;
  std::bitset<kPacket> present_;
};

/// A packet of one.
template <class T>
Packet<T> alone(const T& value) {
  Packet<T> packet;
  packet.set(0, value);
  return packet;
}

/// A straight piece of a light's way.
struct Piece {
  Eigen::Vector3d from;       ///< [m] world
  Eigen::Vector3d direction;  ///< unit
  double length;              ///< [m]
};

class Intersector {
 public:
  /// Keeps a reference to `geometry`, which must outlive it.
  explicit Intersector(const Geometry& geometry);
  ~Intersector();
  Intersector(const Intersector&) = delete;
  Intersector& operator=(const Intersector&) = delete;

  /// First surface of any kind.
  std::optional<Hit> first_hit(const Ray& ray) const;
  /// The same of at most kPacket rays.
  Packet<Hit> first_hits(std::span<const Ray> rays) const;
  /// First boundary of a clear body, as if opaque surfaces were not there.
  std::optional<Hit> first_interface(const Ray& ray) const;
  /// First opaque surface, as if the boundaries of bodies were not there.
  std::optional<Hit> first_opaque(const Ray& ray) const;
  /// Whether an opaque surface stands strictly between two points, each moved `kClearance` towards the other.
  bool occluded(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;
  /// The same of the pieces of a packet, bit by bit.
  std::bitset<kPacket> occluded(const Packet<Piece>& pieces) const;
  /// Whether a surface of any kind stands there.
  std::bitset<kPacket> interrupted(const Packet<Piece>& pieces) const;

  /// d normal / d point of a hit's surface [1/m], for the normal that the hit has.
  Eigen::Matrix3d curvature(const Hit& hit) const;

  /// The clear bodies around a point in the open or in a body, by what a ray enters that comes straight down to it: a
  /// liquid in an opaque cup has no boundary but its surface.
  BodySet bodies_around(const Eigen::Vector3d& point) const;

  const Geometry& geometry() const { return geometry_; }
  /// Whether every clear body is a level liquid in an opaque cup, so that light bends once or never.
  bool level_liquids_only() const { return level_liquids_only_; }

  /// Points that stand on surfaces are taken to be this far off them [m]: above the rounding of float coordinates
  /// (6e-8 of about 1 m), below anything the sensor resolves.
  static constexpr double kClearance = 2e-6;

 private:
  struct Impl;
  const Geometry& geometry_;
  bool level_liquids_only_;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fathom
