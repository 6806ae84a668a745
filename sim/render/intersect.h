// Rays against the scene's surfaces. Embree finds the triangle in float; the point on it is computed again in double.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "core/pose.h"
#include "sim/scene/geometry.h"

namespace fathom {

struct Hit {
  double distance;         ///< [m] along the ray
  Eigen::Vector3d point;   ///< [m] world
  Eigen::Vector3d normal;  ///< unit, of the triangle's plane, on the side the ray came from
  const Surface* surface;
};

class Intersector {
 public:
  /// Keeps a reference to `geometry`, which must outlive it.
  explicit Intersector(const Geometry& geometry);
  ~Intersector();
  Intersector(const Intersector&) = delete;
  Intersector& operator=(const Intersector&) = delete;

  /// First surface of any kind from a point in air.
  std::optional<Hit> first_hit(const Ray& ray) const;
  /// First opaque surface, as if the liquids' surfaces were not there: for rays inside a liquid.
  std::optional<Hit> first_opaque_hit(const Ray& ray) const;
  /// Whether an opaque surface stands strictly between two points, each moved `kClearance` towards the other.
  bool occluded(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

  /// Points that stand on surfaces are taken to be this far off them [m]: above the rounding of float coordinates
  /// (6e-8 of about 1 m), below anything the sensor resolves.
  static constexpr double kClearance = 2e-6;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fathom
