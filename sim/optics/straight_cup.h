// The inside of a straight cup: a level liquid under air, between a wall and a bottom of one diffuse albedo.
#pragma once

#include "sim/optics/interface.h"
#include "sim/optics/phase.h"
#include "sim/optics/random_walk.h"

namespace fathom {

/// The space of a walk in a straight cup (see random_walk.h). z points up along the axis, the liquid's surface is z =
/// 0. Besides leaves(), the visitor is told of `at_wall(walker, normal, albedo)`, before the light is sent back.
class StraightCupSpace {
 public:
  StraightCupSpace(const Turbid& liquid, double radius, double depth, double albedo)
      : liquid_(liquid), radius_(radius), depth_(depth), albedo_(albedo) {}

  enum class Face { surface, wall, bottom };
  struct Boundary {
    double distance;  ///< [m]
    Face face;
  };

  const Turbid& medium(const Walker&) const { return liquid_; }

  Boundary next_boundary(const Walker& walker, double) const {
    const Eigen::Vector3d &p = walker.position, &d = walker.direction;
    const double level = d.z() > 0.0 ? 0.0 : -depth_;
    const double to_level = (level - p.z()) / d.z();  // infinite where the light runs level
    // The far root of |p + t d| = radius; rounding may have left the walker a little outside.
    const double a = d.head<2>().squaredNorm(), b = p.head<2>().dot(d.head<2>());
    const double c = p.head<2>().squaredNorm() - radius_ * radius_;
    const double to_wall = (std::sqrt(std::fmax(0.0, b * b - a * c)) - b) / a;
    if (to_wall < to_level) return {std::fmax(0.0, to_wall), Face::wall};
    return {std::fmax(0.0, to_level), d.z() > 0.0 ? Face::surface : Face::bottom};
  }

  template <class Visitor>
  bool meet(const Boundary& boundary, Walker& walker, Rng& rng, Visitor& visitor) const {
    if (boundary.face == Face::surface) {
      leave_through(walker, -Eigen::Vector3d::UnitZ(), liquid_.n, 1.0, visitor);
      return true;
    }
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
    if (boundary.face == Face::wall) normal << -walker.position.head<2>().normalized(), 0.0;
    bounce_off_wall(walker, normal, albedo_, rng, visitor);
    return true;
  }

 private:
  Turbid liquid_;
  double radius_, depth_, albedo_;
};

}  // namespace fathom
