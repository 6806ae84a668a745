// What heights of a table are rounded to, when that is coarse.
#pragma once

#include <vector>

#include "diagnosis/measurement/frames.h"

namespace fathom {

/// 1 σ of the error that rounding makes of each height that has no cloud [mm]; 0 where all are rounded to less than
/// 0.05 mm, or nothing is.
double rounding_mm(const std::vector<FrameRecord>& frames);

}  // namespace fathom
