// A point of light and every way in which it reaches a point: straight, through clear bodies, or mirrored by them.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "core/rng.h"
#include "sim/render/fan.h"
#include "sim/render/shoot.h"

namespace fathom {

/// What light is asked for: a place on a surface, or one in a medium that scatters.
struct Receiver {
  Eigen::Vector3d point;                    ///< [m] world
  const Body* around;                       ///< the medium there; nullptr is air
  const Eigen::Vector3d* facing = nullptr;  ///< ways that come from behind this normal are left out
  Loss loss = Loss::all;                    ///< on the way
};

class PointLight {
 public:
  /// Keeps a reference to `world`, which must outlive it. A world with more than level liquids in opaque cups is
  /// searched for the directions that lead through its clear bodies: a second, more where they fill much of its view.
  PointLight(const Intersector& world, const Eigen::Vector3d& position);

  /// Calls `visit(i, connection)` for each connection of each of the receivers, by rising i. Straight and level ways
  /// are exact and complete; of the others those are found that lie near a seed (see Fan). Safe to call from several
  /// threads.
  template <class Visit>
  void connect(const Packet<Receiver>& receivers, Visit&& visit) const {
    const Packet<Connection> ways = fan_ ? connect_straight(receivers) : connect_exactly(receivers);
    std::vector<Connection> found;
    for (std::size_t i = 0; i < kPacket; ++i) {
      const Connection* way = ways.find(i);
      if (!fan_) {
        if (way) visit(i, *way);
      } else if (const Receiver* receiver = receivers.find(i)) {
        found.clear();
        if (way) found.push_back(*way);
        connect_from(*fan_, *receiver, found);
        for (const Connection& each : found) visit(i, each);
      }
    }
  }
  /// The same for one: `visit(connection)`.
  template <class Visit>
  void connect(const Receiver& receiver, Visit&& visit) const {
    connect(alone(receiver), [&](std::size_t, const Connection& way) { visit(way); });
  }
  /// The same for light that one interface on its way reflects in part. Where curved surfaces throw but faint light,
  /// chance decides whether it is looked for, and its transmittance is that of all that is not; the less of the light
  /// there counts, by `share`, the fainter it is. Surfaces that are not level are searched for when first asked.
  template <class Visit>
  void connect_mirrored(const Receiver& receiver, double share, Rng& rng, Visit&& visit) const {
    connect_mirrored_each(receiver, share, rng, std::ref(visit));
  }

  const Intersector& world() const { return world_; }
  const Source& source() const { return source_; }
  const Eigen::Vector3d& position() const { return source_.position; }

 private:
  /// The straight ways.
  Packet<Connection> connect_straight(const Packet<Receiver>& receivers) const;
  /// All ways where there are level liquids only.
  Packet<Connection> connect_exactly(const Packet<Receiver>& receivers) const;
  void connect_mirrored_each(const Receiver& receiver, double share, Rng& rng,
                             const std::function<void(const Connection&)>& visit) const;
  void connect_from(const Fan& fan, const Receiver& receiver, std::vector<Connection>& found) const;

  const Intersector& world_;
  Source source_;
  struct Mirror {
    double level;              ///< [m]
    Eigen::AlignedBox2d area;  ///< around the surface
  };
  std::vector<Mirror> mirrors_;  ///< level liquids
  std::optional<Fan> fan_;
  mutable std::once_flag mirrored_once_;
  mutable std::optional<Fan> mirrored_fan_;  ///< where there is a fan
};

}  // namespace fathom
