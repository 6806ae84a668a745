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

/// The view in whose frame they are fused: the first that finds a desk, or else the first.
const PosedDetection& frame_of(const std::vector<PosedDetection>& views);

/// The cups that any view finds, each once, in the frame of frame_of(). Circles are means
/// weighted by their certainty; contents are decided on all views' evidence. For the robust method. At least one view.
Detection fuse_views(const std::vector<PosedDetection>& views, const DetectorSettings& settings);

}  // namespace fathom
