// What a cup holds, from everything that was seen of it in one view or several.
#pragma once

#include <vector>

#include "detector/fill.h"

namespace fathom {

struct DetectedCup;

/// What the decision rests on. Evidence of several views is put together by adding their readings.
struct CupEvidence {
  Bottom bottom;
  double fill_max_m;  ///< from the bottom to the rim
  std::vector<SurfaceReading> readings;
  ContentSigns signs;
  std::string bottom_words;  ///< where the bottom is known from
  std::string solid_words;   ///< what tells a solid filling from a liquid; empty when nothing does
};

/// Fills in the cup's `liquid`, `p_liquid`, `kind`, `fill_m`, `fill_sigma_m` and `why`. Unknown where nothing was seen,
/// and where the surface is not a liquid's.
void decide_content(DetectedCup& cup, const CupEvidence& evidence, const FillSettings& settings);

}  // namespace fathom
