// The place that a thing takes on the desk.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/pose.h"
#include "sim/scene/gltf.h"

namespace fathom {

/// The convex hull of a thing as seen from above, to 0.1 mm.
class Footprint {
 public:
  /// Of triangles in the world; there must be some.
  explicit Footprint(const std::vector<GltfPart>& parts);

  /// Turned by `yaw` [rad] about the origin, then moved.
  Footprint placed(const Eigen::Vector2d& position, double yaw) const;

  /// Least distance [m] between the two; 0 where they meet.
  double distance(const Footprint& other) const;
  /// Whether distance() is below `distance` [m]. Quicker where the two are far apart.
  bool is_within(double distance, const Footprint& other) const;

 private:
  std::vector<Eigen::Vector2d> corners_;  ///< closed, the first is also the last
  Eigen::Vector2d centre_{0, 0};          ///< of a circle around it
  double radius_ = 0.0;
};

}  // namespace fathom
