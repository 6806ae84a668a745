#include "detector/make_template.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "core/error.h"
#include "detector/desk.h"
#include "detector/mean_error.h"
#include "detector/round_wall.h"

namespace fathom {

CupTemplate make_template(std::string name, const DeskView& view, const CupCandidate& candidate,
                          const InteriorSettings& interior, std::optional<double> liquid_threshold_m) {
  assert(candidate.circle);
  const Circle& circle = *candidate.circle;
  const std::optional<InteriorHeight> bottom = interior_height(view.points, circle, interior);
  if (!bottom && !liquid_threshold_m) throw Error(name, "no bottom is seen inside the cup; give the liquid threshold");
  Points points = candidate.points;
  const double segment_low =
      std::min_element(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.z() < b.z(); })->z();
  const double radius = circle.radius_m - interior.margin_m;
  for (const Eigen::Vector3f& point : view.points)
    if (point.z() >= interior.low_m && point.z() < segment_low &&
        (point.head<2>().cast<double>() - circle.center).norm() < radius)
      points.push_back(point);
  CupTemplate cup{std::move(name), thinned(in_template_frame(points, circle)),
                  liquid_threshold_m ? *liquid_threshold_m : bottom->mean_m + kThresholdAboveBottomMetres,
                  candidate.top_m, circle.radius_m};
  if (bottom)
    cup.bottom_sigma_m = MeanError(view.points, view.desk.plane.offset)
                             .of_height(bottom->points, {circle.center.x(), circle.center.y(), bottom->mean_m});
  return cup;
}

CupTemplate template_of_only_cup(std::string name, const Cloud& cloud, const std::optional<DeskPrior>& prior,
                                 std::optional<double> liquid_threshold_m, const std::string& source) {
  const auto desk = find_desk(cloud.points, prior, DeskSearch{});
  if (const NoDesk* none = std::get_if<NoDesk>(&desk)) throw Error(source, none->why);
  const DeskView view = view_over(std::get<PlaneFit>(desk), finite_points(cloud));
  std::vector<CupCandidate> cups = cup_candidates(view, PaperConfig{});
  std::erase_if(cups, [](const CupCandidate& candidate) { return !candidate.rejected.empty(); });
  if (cups.size() != 1)
    throw Error(source, fmt::format("shows {} segments that may be cups, a template needs exactly one", cups.size()));
  CupCandidate& cup = cups.front();
  if (const auto walls = find_round_walls(cup.points, WallSearch{}); walls.size() == 1)
    cup.circle = Circle{walls[0].center, walls[0].radius_m, walls[0].rms_m};  // a handle moves the plain circle
  return make_template(std::move(name), view, cup, InteriorSettings{}, liquid_threshold_m);
}

}  // namespace fathom
