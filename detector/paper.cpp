#include "detector/paper.h"

#include <fmt/format.h>

#include "core/units.h"
#include "detector/judge_segments.h"

namespace fathom {
namespace {

std::string far_from_template(const TemplateMatch& match, const CupTemplate& known, const IcpSettings& icp) {
  return fmt::format("mean distance {:.1f} mm from {} is above {:g} mm", mm_from_metres(match.score_m), known.name,
                     mm_from_metres(icp.score_max_m));
}

Placement place_by_icp(CupCandidate candidate, const std::vector<CupTemplate>& templates, const IcpSettings& icp) {
  if (!candidate.rejected.empty()) return RejectedSegment{std::move(candidate), std::nullopt};
  const auto match = match_templates(candidate, templates, icp);
  if (match && match->score_m <= icp.score_max_m) return PlacedCup{std::move(candidate), *match};
  candidate.rejected =
      match ? far_from_template(*match, templates[match->index], icp) : "there is no template to match";
  return RejectedSegment{std::move(candidate), match};
}

}  // namespace

Detection detect_paper(const Cloud& cloud, const DetectorSettings& settings) {
  return judge_segments(cloud, settings, "matches", [&](CupCandidate candidate) {
    return place_by_icp(std::move(candidate), settings.templates, settings.paper.icp);
  });
}

}  // namespace fathom
