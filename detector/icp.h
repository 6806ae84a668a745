// How well a segment fits a known cup: iterative closest point, scored by the mean distance. Paper, section V-D.
#pragma once

#include <optional>
#include <vector>

#include "detector/cup_template.h"

namespace fathom {

struct IcpSettings {
  double score_max_m = 0.010;  ///< the paper gives no number
  int iterations_max = 30;
};

struct TemplateMatch {
  std::size_t index;  ///< of the template
  double score_m;  ///< mean distance of the segment's points, thinned as the template's, from their nearest points of
                   ///< the template
  int iterations;
};

/// The template with the smallest score, each aligned from its place at the candidate's circle with its y axis away
/// from the camera. The candidate must have a circle. Nothing when there is no template.
std::optional<TemplateMatch> match_templates(const CupCandidate& candidate, const std::vector<CupTemplate>& templates,
                                             const IcpSettings& settings);

}  // namespace fathom
