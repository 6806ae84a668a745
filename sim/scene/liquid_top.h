// The upper surface of a liquid in a cup: a smooth height above a round, plus the triangles that stand for it.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "sim/optics/meniscus.h"
#include "sim/scene/mesh.h"
#include "sim/scene/scene.h"

namespace fathom {

/// Facets around the axis: the corners of twice as many stay within a micrometre of a wall of 40 mm.
inline constexpr int kLiquidFacets = 2 * kFacetsAround;

/// Height above the desk [m] at which a liquid that is level at `level` far from the wall touches it, where the
/// meniscus of the wall's lean there ends: at a sharp corner of the profile it stays.
double contact_height(const CupShape& shape, double level, const Wetting& wetting);

/// z = level + gradient · (x, y) + Σ amplitude sin(k · (x, y) + phase) + meniscus(radius − ρ), x and y from the cup's
/// axis, ρ their distance from it.
class LiquidTop {
 public:
  /// `level` [m] above the desk at the axis, without ripples; the axis at the origin.
  LiquidTop(const CupShape& shape, double level, const LiquidForm& form);

  struct Height {
    double z;
    Eigen::Vector2d gradient;
    Eigen::Matrix2d hessian;  ///< [1/m]
  };
  Height at(const Eigen::Vector2d& xy) const;

  /// Triangles with their corners on the surface, facing up, that end inside the wall: bodies overlap, the solid wins.
  /// The last kLiquidFacets vertices are the rim. The axis at the origin.
  Mesh mesh(const CupShape& shape) const;

  void move(const Eigen::Vector2d& shift) { axis_ += shift; }

  bool has_waves() const { return !waves_.empty(); }
  /// Every wave in this direction and phase (see Ripple).
  void turn_waves(double azimuth, double phase);

  bool operator==(const LiquidTop&) const = default;

 private:
  struct Wave {
    Eigen::Vector2d k;  ///< [rad/m]
    double amplitude, phase;

    bool operator==(const Wave&) const = default;
  };

  /// Distance from the axis at which the mesh ends, by facet [m].
  std::vector<double> rim(const CupShape& shape) const;

  Eigen::Vector2d axis_ = Eigen::Vector2d::Zero();
  double level_;
  Eigen::Vector2d gradient_;
  std::vector<Wave> waves_;
  std::optional<Meniscus> meniscus_;
  double radius_ = 0.0;  ///< of the wall where the meniscus touches it
};

/// Sides and underside of the liquid under `top`, whose mesh is `surface`, in a clear cup of revolution: just inside
/// the wall, where the solid wins. Both about the axis at the origin.
Mesh liquid_shell(const CupShape& shape, const LiquidTop& top, const Mesh& surface);

}  // namespace fathom
