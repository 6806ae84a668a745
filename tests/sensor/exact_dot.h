// What one projected dot must look like on level ground, bare or under a level liquid: by Snell's law, the theory's
// triangulation and the conservation of power, without the renderer.
#pragma once

#include <Eigen/Core>

#include "sim/scene/rig.h"

namespace fathom {

/// A level diffuse surface, bare or under a liquid.
struct Ground {
  double z, albedo;
  double fill = 0.0, index = 1.0, absorption = 0.0;  ///< of the liquid
};

/// The image of one dot: its place, and the sum of its pixels.
struct DotImage {
  Eigen::Vector2d centre_ir_px;
  double sum_dn;
};

/// Of a small dot in a direction of the projector (rectified, in units of the focal length). The ground must not lie
/// straight below the camera or the projector.
DotImage exact_dot(const Rig& rig, const Eigen::Vector2d& direction, const Ground& ground);

}  // namespace fathom
