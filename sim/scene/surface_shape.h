// What the triangles of a refracting surface stand for: themselves, or something smooth that rays are brought onto.
#pragma once

#include <Eigen/Core>
#include <variant>
#include <vector>

#include "sim/scene/liquid_top.h"

namespace fathom {

/// Flat triangles as they are.
struct Facets {};

/// Flat triangles whose normal is interpolated linearly between their corners (glTF's NORMAL).
struct VertexNormals {
  std::vector<Eigen::Vector3d> normals;  ///< by vertex of the mesh; shorter than a unit where triangles were cut
};

/// A cone about an upright axis: radius = radius_at_desk + slope · z. A cylinder with slope 0.
struct Cone {
  Eigen::Vector2d axis;
  double radius_at_desk;  ///< [m]
  double slope;
};

using SurfaceShape = std::variant<Facets, VertexNormals, Cone, LiquidTop>;

/// A smooth surface as the zeros of a function f [m] of the place.
struct Implicit {
  double value;
  Eigen::Vector3d gradient;
  Eigen::Matrix3d hessian;  ///< [1/m]
};
Implicit implicit(const Cone& cone, const Eigen::Vector3d& point);
Implicit implicit(const LiquidTop& top, const Eigen::Vector3d& point);

}  // namespace fathom
