// Plane layers, one below the other, between air above and air below: what the tables of radiative transfer are about.
#pragma once

#include <limits>
#include <vector>

#include "sim/optics/interface.h"
#include "sim/optics/random_walk.h"

namespace fathom {

struct Layer {
  Turbid medium;
  double thickness;  ///< [m]; infinite only in the lowest layer
};

/// The space of a walk through layers (see random_walk.h). z points up, the top is z = 0; regions count from 0 at the
/// top.
class LayerSpace {
 public:
  /// At least one layer, thicknesses above 0.
  explicit LayerSpace(std::vector<Layer> layers);

  struct Boundary {
    double distance;  ///< [m]
    bool below;       ///< the layer's lower face
  };

  const Turbid& medium(const Walker& walker) const { return layers_[walker.region].medium; }
  const std::vector<Layer>& layers() const { return layers_; }

  Boundary next_boundary(const Walker& walker, double) const {
    const double dz = walker.direction.z();
    if (dz == 0.0) return {std::numeric_limits<double>::infinity(), true};
    const std::size_t face = walker.region + (dz < 0.0 ? 1 : 0);
    // Rounding may have left the walker a little beyond the face that it was put on.
    return {std::fmax(0.0, (face_z_[face] - walker.position.z()) / dz), dz < 0.0};
  }

  template <class Visitor>
  bool meet(const Boundary& boundary, Walker& walker, Rng& rng, Visitor& visitor) const {
    const Eigen::Vector3d normal(0.0, 0.0, boundary.below ? 1.0 : -1.0);
    if (std::isinf(boundary.distance)) {  // never comes back; what is not absorbed on the way passes every depth
      if (walker.weight > 0.0) visitor.leaves(walker, normal, walker.weight);
      return false;
    }
    const std::uint64_t beyond = walker.region + (boundary.below ? 1 : -1);  // above the top: a huge number
    if (beyond >= layers_.size())
      leave_through(walker, normal, medium(walker).n, 1.0, visitor);
    else if (cross_interface(walker, normal, medium(walker).n, layers_[beyond].medium.n, rng))
      walker.region = beyond;
    return true;
  }

 private:
  std::vector<Layer> layers_;
  std::vector<double> face_z_;  ///< layers + 1, from the top
};

}  // namespace fathom
