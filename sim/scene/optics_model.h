// What lenses do to the image: their grain, what is out of focus, distortion.
#pragma once

#include <Eigen/Core>
#include <span>

#include "core/json_fwd.h"

namespace fathom {

/// Distortions are radial: a direction at x, y (over the focal length, r² = x² + y²) appears at x, y times
/// 1 + k1 r² + k2 r⁴ (Brown 1966); negative k1 is a barrel, positive a pincushion.
struct OpticsModel {
  double f_number = 3.2;  ///< of the infrared camera, whose speckle has grains of λ F
  double pixel_um = 5.2;  ///< pitch of its pixels (MT9M001's)
  double focus = 0.0;     ///< [m] distance that it sees sharply; 0 = all
  double beam = 0.0;      ///< [m] width (4 σ) of the projector's beams as they leave it; 0 = rays
  double camera_k1 = 0.0, camera_k2 = 0.0;
  double projector_k1 = 0.0;

  bool distorts() const { return camera_k1 != 0.0 || camera_k2 != 0.0; }
  bool defocuses() const { return focus > 0.0 || beam > 0.0; }
  /// Where the camera sees the direction x, y; and the direction that it sees there.
  Eigen::Vector2d distorted(const Eigen::Vector2d& direction) const {
    const double squared = direction.squaredNorm();
    return direction * (1.0 + squared * (camera_k1 + squared * camera_k2));
  }
  Eigen::Vector2d undistorted(const Eigen::Vector2d& seen_at) const;

  bool operator==(const OpticsModel&) const = default;
};

std::span<const Field<OpticsModel>> optics_fields();

}  // namespace fathom
