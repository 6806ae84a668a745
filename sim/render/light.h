// A point of light and every way in which it reaches a point: straight, through clear bodies, or mirrored by them.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
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

/// A way that leads to a point, as far as it is known from points beside it.
struct Start {
  Eigen::Vector3d direction;  ///< unit, about that in which the light leaves
  int crossings, mirror;      ///< as in Connection
};

/// Of receiver `i`, what is known of its ways, if anything.
using Starts = std::function<std::optional<std::vector<Start>>(std::size_t i)>;

class PointLight {
 public:
  /// Keeps a reference to `world`, which must outlive it. A world with more than level liquids in opaque cups is
  /// searched for the directions that lead through its clear bodies: a second, more where they fill much of its view.
  PointLight(const Intersector& world, const Eigen::Vector3d& position);

  /// Calls `visit(i, connection)` for each connection of each of the receivers, by rising i. Straight and level ways
  /// are exact and complete; of the others those are found that lie near a seed (see Fan). Safe to call from several
  /// threads.
  ///   `starts(i)` may say how all ways to a receiver but the straight one start, from points beside it. If they can be
  /// followed, no others are searched for.
  template <class Visit>
  void connect(const Packet<Receiver>& receivers, Visit&& visit, const Starts& starts = {}) const {
    if (fan_) return connect_by_search(receivers, std::ref(visit), starts);
    const Packet<Connection> ways = connect_exactly(receivers);
    for (std::size_t i = 0; i < kPacket; ++i)
      if (const Connection* way = ways.find(i)) visit(i, *way);
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
  void connect_mirrored(const Receiver& receiver, double share, double drawn, Visit&& visit) const {
    connect_mirrored_each(receiver, share, drawn, std::ref(visit));
  }

  /// Whether there are ways that connect() has to search for.
  bool searches() const { return fan_.has_value(); }
  /// These ways: all but the straight one, or all that one interface reflects in part, however faint.
  std::vector<Connection> search(Ways ways, const Receiver& receiver) const;
  /// Adds the ways to a receiver that start so. Where they do not all get there, each on its own, others may: then none
  /// are added, and the answer is no.
  bool follow(std::span<const Start> starts, const Receiver& receiver, std::vector<Connection>& found) const;

  const Intersector& world() const { return world_; }
  const Source& source() const { return source_; }
  const Eigen::Vector3d& position() const { return source_.position; }

 private:
  /// The straight ways.
  Packet<Connection> connect_straight(const Packet<Receiver>& receivers) const;
  /// All ways where there are level liquids only.
  Packet<Connection> connect_exactly(const Packet<Receiver>& receivers) const;
  void connect_mirrored_each(const Receiver& receiver, double share, double drawn,
                             const std::function<void(const Connection&)>& visit) const;
  void connect_level_mirrors(const Receiver& receiver, std::vector<Connection>& found) const;
  const Fan& mirrored_fan() const;
  void connect_by_search(const Packet<Receiver>& receivers,
                         const std::function<void(std::size_t, const Connection&)>& visit, const Starts& starts) const;
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
