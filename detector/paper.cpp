#include "detector/paper.h"

#include <fmt/format.h>

#include "core/units.h"
#include "detector/cluster.h"

namespace fathom {
namespace {

Points between_heights(const Points& points, double low_m, double high_m) {
  Points result;
  for (const Eigen::Vector3f& point : points)
    if (point.z() > low_m && point.z() <= high_m) result.push_back(point);
  return result;
}

std::string decision_in_words(const DetectedCup& cup, const CupTemplate& known) {
  if (!cup.interior) return fmt::format("matches {}; nothing is seen inside it", known.name);
  return fmt::format("matches {}; mean height inside {:.1f} mm is {} its threshold of {:g} mm", known.name,
                     mm_from_metres(cup.interior->mean_m), cup.liquid == Liquid::kYes ? "above" : "not above",
                     mm_from_metres(known.liquid_threshold_m));
}

std::string far_from_template(const TemplateMatch& match, const CupTemplate& known, const IcpSettings& icp) {
  return fmt::format("mean distance {:.1f} mm from {} is above {:g} mm", mm_from_metres(match.score_m), known.name,
                     mm_from_metres(icp.score_max_m));
}

Eigen::Vector3d center_in_camera(const DeskView& view, const Circle& circle) {
  return view.desk_from_camera.inverse() * Eigen::Vector3d(circle.center.x(), circle.center.y(), kCenterHeightMetres);
}

}  // namespace

std::variant<DeskView, NoDesk> view_of_desk(const Cloud& cloud, const std::optional<DeskPrior>& prior,
                                            const PlaneSearch& search) {
  Points points = finite_points(cloud);
  if (points.size() < 3) return NoDesk{fmt::format("no desk: the cloud has {} measured points", points.size())};
  const std::vector<PlaneFit> planes = find_planes(points, search);
  const std::optional<PlaneFit> desk = choose_desk(planes, prior, search);
  if (!desk)
    return NoDesk{fmt::format("no desk: none of {} planes lies {}", planes.size(),
                              prior ? "where the sensor's height and pitch put it" : "below the camera")};
  const Eigen::Isometry3d to_desk = desk_from_camera(desk->plane);
  for (Eigen::Vector3f& point : points) point = (to_desk * point.cast<double>()).cast<float>();
  return DeskView{*desk, to_desk, std::move(points)};
}

std::vector<Candidate> cup_candidates(const DeskView& view, const PaperConfig& config) {
  const Points above = between_heights(view.points, config.plane.threshold_m, config.height_max_m);
  std::vector<Candidate> candidates;
  for (Points& segment : euclidean_clusters(above, config.cluster_distance_m, config.cluster_points_min))
    candidates.push_back(examine_segment(std::move(segment), config.cup));
  return candidates;
}

Detection detect_paper(const Cloud& cloud, const DetectorSettings& settings) {
  const PaperConfig& config = settings.paper;
  Detection result;
  StageClock clock(result.stages);
  const auto found = view_of_desk(cloud, settings.prior, config.plane);
  if (const NoDesk* none = std::get_if<NoDesk>(&found)) {
    result.why = none->why;
    return result;
  }
  const DeskView& view = std::get<DeskView>(found);
  result.desk = view.desk;
  clock.done("desk");
  std::vector<Candidate> candidates = cup_candidates(view, config);
  clock.done("segments");

  for (Candidate& candidate : candidates) {
    ++result.segments;
    if (!candidate.rejected.empty()) {
      result.rejected.push_back({std::move(candidate), std::nullopt});
      continue;
    }
    const auto match = match_templates(candidate, settings.templates, config.icp);
    clock.done("templates");
    if (!match || match->score_m > config.icp.score_max_m) {
      candidate.rejected = match ? far_from_template(*match, settings.templates[match->index], config.icp)
                                 : "there is no template to match";
      result.rejected.push_back({std::move(candidate), match});
      continue;
    }
    const CupTemplate& known = settings.templates[match->index];
    DetectedCup cup;
    cup.match = *match;
    cup.score_m = match->score_m;
    cup.center_in_camera = center_in_camera(view, *candidate.circle);
    cup.interior = interior_height(view.points, *candidate.circle, config.interior);
    cup.liquid = decide_liquid(cup.interior, known.liquid_threshold_m);
    cup.why = decision_in_words(cup, known);
    cup.candidate = std::move(candidate);
    result.cups.push_back(std::move(cup));
    clock.done("content");
  }
  return result;
}

}  // namespace fathom
