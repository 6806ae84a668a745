// The measurement of the paper's section III: the height of what is seen in a cup that stands at a known place.
#pragma once

#include <optional>

#include "app/rig.h"
#include "core/cloud_file.h"
#include "detector/cloud.h"
#include "detector/liquid.h"

namespace fathom {

/// Mean height above the fitted desk of the points inside the cup that is nearest to `cup_in_world` [m], if it is
/// nearer than its outer radius. Nothing when there is no desk, no such cup, or when too little is seen inside.
std::optional<InteriorHeight> height_in_cup(const Cloud& cloud, const LaboratoryRig& rig,
                                            const Eigen::Vector2d& cup_in_world);

/// A simulated cloud as the detector takes it.
Cloud cloud_from_image(const Image<CloudPoint>& image);

}  // namespace fathom
