// Several views of one desk as one: what hides a cup from one camera does not from the next, and a clear liquid raises
// its bottom by another amount in each.
#pragma once

#include "core/pose.h"
#include "detector/detector.h"

namespace fathom {

struct PosedDetection {
  Detection detection;
  Pose world_from_camera;
};

/// The cups that any view finds, each once, in the frame of the first view that finds a desk. Circles are means
/// weighted by their certainty; contents are decided on all views' evidence. For the robust method. At least one view.
Detection fuse_views(const std::vector<PosedDetection>& views, const DetectorSettings& settings);

}  // namespace fathom
