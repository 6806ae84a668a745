// The two rays by which a pixel is measured, with every place where they bend: for pictures of them.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "sim/render/connection.h"
#include "sim/scene/rig.h"

namespace fathom {

/// All points in the world [m]. A ray without bends is straight.
struct PixelRays {
  SeenPoint seen;                                ///< where both rays end
  std::vector<Eigen::Vector3d> camera_bends;     ///< from the camera on
  std::optional<Illumination> light;             ///< the strongest; nothing where the projector is hidden
  std::vector<Eigen::Vector3d> projector_bends;  ///< of that light, from the projector on
};

/// The rays of the point (x_px, y_px) of the depth image, as trace_truth() has them. Nothing where the camera's ray
/// meets no surface.
std::optional<PixelRays> rays_of_pixel(const PointLight& projector, const Rig& rig, double x_px, double y_px);

}  // namespace fathom
