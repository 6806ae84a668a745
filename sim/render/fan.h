// Where to start aiming: rays from a source in all directions in which it sees clear bodies, traced once, each standing
// for the small pencil around it. A point's connections lie in the pencils that it lies in.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "sim/render/shoot.h"

namespace fathom {

/// One straight piece of a traced ray, behind at least one interface. A search asks hundreds whether a place lies near
/// them: what says so stands first, and what does not depend on the place is worked out once.
struct Seed {
  const Body* medium;              ///< around the piece
  double begin, end;               ///< [m] along the piece: where it may light something
  Eigen::Vector3d origin;          ///< [m] the piece's beginning
  Eigen::Vector3d heading;         ///< unit
  Eigen::Vector3d squared_reach;   ///< [m²] half the pencil's width, squared: a polynomial in the distance
  Matrix32d across;                ///< perpendicular_to(heading)
  Eigen::Matrix2d jacobian;        ///< [m/rad] of a landing at the origin …
  Eigen::Matrix2d jacobian_per_m;  ///< [1/rad] … and how it changes with the distance
  double spacing;                  ///< [rad] from the neighbouring seeds
  Eigen::Vector3d direction;       ///< in which the light left the source
  double transmittance;            ///< of power from the source to the piece's beginning
  int crossings;
  int mirror;  ///< number of the interface that reflected in part, or kNoMirror

  double reach(double distance) const;                 ///< [m] half the pencil's width
  Eigen::Matrix2d jacobian_at(double distance) const;  ///< [m/rad] of a landing
};

/// Interfaces on the ways that are looked for; light that is trapped in a wall goes on for long.
inline constexpr int kLongestChain = 8;

/// Whether one of the interfaces on a way reflects in part, or none.
enum class Ways { refracted, mirrored };

class Fan {
 public:
  Fan(const Intersector& world, const Source& source, Ways ways);

  struct Candidate {
    const Seed* seed;
    double steps;  ///< from the seed to where light would land on the target if the landing were linear, in spacings
    double miss;   ///< [m] of the seed itself
    Eigen::Vector2d step;  ///< [rad] the same way; 0 where the landing is far from linear
    bool by_step;          ///< whether it is not
    bool turned_over;      ///< as in Connection

    /// That would land on the target if the landing were linear; not of unit length.
    Eigen::Vector3d direction() const { return seed->direction + perpendicular_to(seed->direction) * step; }
  };
  /// The seeds near whose pencils `target` lies in the medium `around`, the nearest first.
  std::vector<Candidate> near(const Eigen::Vector3d& target, const Body* around) const;

  /// About the most that light gets to [1/m²] in the box of 5 mm in which `target` lies: transmittance · spreading.
  double strength_near(const Eigen::Vector3d& target) const;

 private:
  void send(const Intersector& world, const Source& source, const Eigen::Vector3d& direction, double spacing,
            int halvings);
  /// Adds the pieces of a flight that left in a direction and has passed `crossings` interfaces. Whether one of them is
  /// too wide.
  bool follow(const Intersector& world, Flight flight, const Eigen::Vector3d& direction, double spacing, int crossings,
              int mirror);
  void file(std::uint32_t seed);

  struct Box {
    std::vector<std::uint32_t> seeds;  ///< whose pencils touch it
    double strength = 0.0;             ///< as strength_near()
  };
  /// nullptr where no pencil touches it.
  const Box* box_near(const Eigen::Vector3d& point) const;

  Ways ways_;
  std::vector<Seed> seeds_;
  std::unordered_map<std::uint64_t, Box> boxes_;
};

}  // namespace fathom
