// A scene as surfaces in the world, ready to be traced.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "sim/scene/mesh.h"
#include "sim/scene/scene.h"

namespace fathom {

/// Lambert's surface.
struct Diffuse {
  double albedo;
};

/// The level surface of a clear liquid, at z = level [m].
struct LiquidSurface {
  double level;
  double n;           ///< refractive index of the liquid below; air above
  double absorption;  ///< μa of the liquid [1/m]
};

struct Surface {
  int object;  ///< index into Geometry::objects plus 1; 0 means nothing
  Mesh mesh;
  std::variant<Diffuse, LiquidSurface> optics;
};

struct Geometry {
  std::vector<std::string> objects;  ///< names, e.g. "desk", "cup 0 paper_cup", "cup 0 water"
  std::vector<Surface> surfaces;
  std::vector<std::string> approximations;  ///< what the model leaves out of this scene, one sentence each
};

/// Builds the surfaces; media are evaluated at `wavelength_nm`. Throws Error on unreadable glTF files and on a medium
/// asked outside its range. A liquid that scatters becomes an opaque diffuse surface (see Geometry::approximations).
Geometry build_geometry(const Scene& scene, double wavelength_nm);

}  // namespace fathom
