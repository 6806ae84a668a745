// A scene as surfaces in the world, ready to be traced.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sim/optics/glaze.h"
#include "sim/optics/random_walk.h"
#include "sim/scene/mesh.h"
#include "sim/scene/scene.h"
#include "sim/scene/surface_shape.h"

namespace fathom {

/// Room inside an upright wall of revolution.
struct Vessel {
  Eigen::Vector2d axis;                  ///< [m] world
  std::vector<Eigen::Vector2d> profile;  ///< of the wall, (radius, height) [m], from the bottom's centre to the rim

  /// Least distance [m] from a point inside to the wall's mesh, or a little less.
  double clearance(const Eigen::Vector3d& point) const;
};

/// A body that light enters: a liquid, a cup's glass wall, a transmissive glTF mesh.
struct Body {
  int object;                         ///< as in Surface
  Turbid medium;                      ///< at the scene's wavelength; air has the index 1
  double surface_albedo = 0.0;        ///< of a body that scatters, if it were opaque (diffuse_reflectance)
  std::optional<double> level = {};   ///< height [m] of a liquid in a cup, without tilt, ripples and meniscus
  bool plain = false;                 ///< a level liquid in an opaque cup, apart from other bodies: light bends once
  std::optional<Vessel> vessel = {};  ///< around a plain liquid in a cup of revolution
  Turbid without_peak = without_forward_peak(medium);  ///< for light that is scattered

  bool scatters() const { return medium.scattering > 0.0; }
};

/// The bodies that a point lies in, bit i for Geometry::bodies[i]. Of bodies that overlap the last one wins.
using BodySet = std::uint64_t;

/// Lambert's surface.
struct Diffuse {
  double albedo;
};

/// A glazed surface, by the medium in front of it: air, then Geometry::bodies in their order.
struct Glazed {
  std::vector<Glaze> under;
};

/// Part of the boundary of a body; the triangles face out of it.
struct Interface {
  int body;  ///< index into Geometry::bodies
  /// Of a clear cup from a mesh: the liquid in the cup, which has no boundary of its own at the wall but ends and
  /// begins where the wall does.
  std::optional<int> liquid = {};
  bool wetted = false;  ///< whether that liquid is what lies outside these triangles
};

struct Surface {
  int object;  ///< index into Geometry::objects plus 1; 0 means nothing
  Mesh mesh;
  std::variant<Diffuse, Glazed, Interface> optics;
  SurfaceShape shape = Facets{};
};

/// Numbers of objects, as in Surface.
struct CupObjects {
  int cup;
  std::optional<int> liquid;
};

struct Geometry {
  std::vector<std::string> objects;     ///< names, e.g. "desk", "cup 0 paper_cup", "cup 0 water"
  std::vector<Pose> world_from_object;  ///< of each; a liquid's is its cup's
  std::vector<CupObjects> cups;         ///< in the scene's order
  std::vector<int> things;              ///< numbers of the scene's objects, in its order
  std::vector<Surface> surfaces;
  /// By rising priority: liquids in cups, glTF bodies (by rising index), walls of cups. At most 64.
  std::vector<Body> bodies;
  std::vector<std::string> approximations;  ///< what the model leaves out of this scene, one sentence each
};

/// Builds the surfaces; media are evaluated at `wavelength_nm`. Throws Error on unreadable glTF files, on a medium
/// asked outside its range and on more than 64 bodies.
Geometry build_geometry(const Scene& scene, double wavelength_nm);

}  // namespace fathom
