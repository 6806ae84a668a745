#include "detector/judge_segments.h"

#include <fmt/format.h>

#include "core/units.h"
#include "detector/cone.h"

namespace fathom {
namespace {

std::string content_in_words(const DetectedCup& cup, const CupTemplate& known) {
  if (!cup.interior) return "nothing is seen inside it";
  return fmt::format("mean height inside {:.1f} mm is {} its threshold of {:g} mm",
                     mm_from_metres(cup.interior->mean_m), cup.liquid == Liquid::kYes ? "above" : "not above",
                     mm_from_metres(known.liquid_threshold_m));
}

DetectedCup with_content(PlacedCup placed, const DeskView& view, const DetectorSettings& settings,
                         std::string_view matches) {
  const CupTemplate& known = settings.templates[placed.match.index];
  const Circle& circle = *placed.candidate.circle;
  DetectedCup cup;
  cup.match = placed.match;
  cup.score_m = placed.match.score_m;
  cup.center_in_camera =
      view.desk_from_camera.inverse() * Eigen::Vector3d(circle.center.x(), circle.center.y(), kWallHeight);
  cup.interior = interior_height(view.points, circle, settings.paper.interior);
  cup.liquid = decide_liquid(cup.interior, known.liquid_threshold_m);
  cup.why = fmt::format("{} {}; {}", matches, known.name, content_in_words(cup, known));
  cup.candidate = std::move(placed.candidate);
  return cup;
}

}  // namespace

Detection judge_segments(const Cloud& cloud, const DetectorSettings& settings, std::string_view matches,
                         const std::function<Placement(CupCandidate)>& place) {
  Detection result;
  StageClock clock(result.stages);
  const auto found = view_of_desk(cloud, settings.prior, settings.paper.plane);
  if (const NoDesk* none = std::get_if<NoDesk>(&found)) {
    result.why = none->why;
    return result;
  }
  const DeskView& view = std::get<DeskView>(found);
  result.desk = view.desk;
  clock.done("desk");
  std::vector<CupCandidate> candidates = cup_candidates(view, settings.paper);
  clock.done("segments");
  for (CupCandidate& candidate : candidates) {
    ++result.segments;
    Placement placement = place(std::move(candidate));
    clock.done("templates");
    if (RejectedSegment* none = std::get_if<RejectedSegment>(&placement)) {
      result.rejected.push_back(std::move(*none));
      continue;
    }
    result.cups.push_back(with_content(std::get<PlacedCup>(std::move(placement)), view, settings, matches));
    clock.done("content");
  }
  return result;
}

}  // namespace fathom
