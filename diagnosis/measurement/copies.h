// Frames that were not measured but copied: one cloud, or the same numbers, in two rows.
#pragma once

#include <span>

#include "diagnosis/measurement/cloud_print.h"
#include "diagnosis/measurement/frames.h"
#include "diagnosis/statistics/evidence.h"

namespace fathom {

struct Copies {
  std::vector<bool> left_out;     ///< of each frame, whether it does not count
  std::vector<Mistake> mistakes;  ///< "duplicated_trial"
};

/// Of a cloud that stands in several rows of one liquid, fill and place the first counts; of one that stands for two of
/// these, none: nobody knows which it was. Where all trials repeat the first of their placement, or all frames the
/// first of their condition, nothing is a copy if nothing scatters: if the desk around the cups is the same to the bit
/// in other clouds. `prints`: one of each frame. Of rows without clouds height, spread and points tell, within a
/// placement, where many more are alike than have all of another but the height or the points.
Copies find_copies(const std::vector<FrameRecord>& frames, std::span<const CloudPrint> prints);

}  // namespace fathom
