// Connections by shooting: a ray is aimed again and again until it lands on the point, through any chain of smooth
// interfaces. The derivative of the landing, carried along with the ray, both steers the aim (Newton) and is the
// spreading of the light.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/optics/ray_differential.h"
#include "sim/render/crossing.h"

namespace fathom {

/// One way in which light gets from a source to a point.
struct Connection {
  Eigen::Vector3d direction;  ///< unit, in which the light leaves the source
  Eigen::Vector3d arrival;    ///< unit, in which it travels at the point
  double spreading;           ///< [1/m²] solid angle at the source per area perpendicular to `arrival` at the point
  double transmittance;       ///< of power on the way: Fresnel and Beer–Lambert
  int crossings;              ///< interfaces on the way; 0 is the straight way
  bool turned_over;           ///< whether neighbouring rays land mirror-inverted, as they do past a caustic
  /// Whether it has come out of a body that scatters; where such bodies are taken as opaque, this light is not there.
  bool through_scattering = false;
  bool partly_mirrored = false;  ///< whether an interface on it reflects in part
  std::int8_t mirror = -1;       ///< the interface's number, or kNoMirror
};

/// Where the light comes from, and what bodies it starts in.
struct Source {
  Eigen::Vector3d position;  ///< [m] world
  BodySet inside;
};

/// A pencil of light after a number of interfaces. Light that cannot pass one is totally reflected there.
struct Flight {
  RayDifferential differential;
  BodySet inside;
  double transmittance;  ///< from the source to the pencil's origin
  Loss loss = Loss::all;
};

/// Longest chain that is followed.
inline constexpr int kMostCrossings = 24;

/// What an interface does to the light: usually it refracts; of mirror images one reflects in part.
enum class Event { refract, reflect };
/// As the number, from 0, of the interface on a way that reflects in part: none does.
inline constexpr int kNoMirror = -1;

/// Carries the flight to the crossing and over it, or back from it. Refraction becomes total reflection where it must.
/// Returns the reflectance there.
double pass(const Intersector& world, const Crossing& crossing, Event event, Flight& flight);

/// Another direction to start from, and by how much [m] the first one misses.
struct Guess {
  Eigen::Vector3d direction;
  double miss;
};

/// Aims at `target`, which lies in the medium `around` (nullptr: air), by way of exactly `crossings` interfaces,
/// starting from `direction`, or from `guess` if that leads nearer; number `mirror` of them reflects. Nothing when
/// Newton's method finds no such way or something opaque stands in it.
std::optional<Connection> shoot(const Intersector& world, const Source& source, const Eigen::Vector3d& target,
                                const Body* around, const Eigen::Vector3d& direction, int crossings,
                                int mirror = kNoMirror, Loss loss = Loss::all, const Guess* guess = nullptr);

/// Adds a way, if there is one, that has not been found before.
void add_new(std::vector<Connection>& found, const std::optional<Connection>& way);

}  // namespace fathom
