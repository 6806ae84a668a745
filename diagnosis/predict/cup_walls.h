// A cup's walls as camera and projector see them: straight light on what stands in air.
#pragma once

#include "diagnosis/predict/cup_optics.h"

namespace fathom {

/// The outer wall or, through the opening, the inner one above the `surface` of what stands in the cup, if anything
/// does. Nothing where a ray from the camera meets anything else, or where the projector's light does not come.
std::optional<LitPoint> look_at_wall(const CupBody& cup, const LiquidTop* surface, const Ray& camera_ray,
                                     const Eigen::Vector3d& projector);

}  // namespace fathom
