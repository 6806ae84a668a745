#include "app/cup_height.h"

#include "detector/paper.h"

namespace fathom {
namespace {

/// The candidate nearest to where the cup stands, if it is nearer than the cup's outer radius.
std::optional<Candidate> candidate_at(const DeskView& view, const Eigen::Vector2d& place, double within_m) {
  std::optional<Candidate> nearest;
  const auto distance = [&](const Candidate& candidate) { return (candidate.circle->center - place).norm(); };
  for (Candidate& candidate : cup_candidates(view, PaperConfig{})) {
    if (!candidate.rejected.empty() || distance(candidate) > within_m) continue;
    if (!nearest || distance(candidate) < distance(*nearest)) nearest = std::move(candidate);
  }
  return nearest;
}

}  // namespace

std::optional<InteriorHeight> height_in_cup(const Cloud& cloud, const LaboratoryRig& rig,
                                            const Eigen::Vector2d& cup_in_world) {
  const auto found = view_of_desk(cloud, DeskPrior{rig.height_m, rig.pitch_rad, rig.roll_rad}, PlaneSearch{});
  const DeskView* view = std::get_if<DeskView>(&found);
  if (!view) return std::nullopt;
  // The world's origin is below the middle of the baseline, the desk frame's below the camera at its left end.
  const Eigen::Vector2d cup_in_desk = cup_in_world + Eigen::Vector2d(0.5 * rig.baseline_m, 0.0);
  const std::optional<Candidate> cup = candidate_at(*view, cup_in_desk, rig.outer_radius_m);
  return cup ? interior_height(view->points, *cup->circle, InteriorSettings{}) : std::nullopt;
}

Cloud cloud_from_image(const Image<CloudPoint>& image) {
  Cloud cloud{.points = {}, .intensity = {}, .width = image.width(), .height = image.height()};
  cloud.points.reserve(image.size());
  cloud.intensity.reserve(image.size());
  for (const CloudPoint& point : image.pixels()) {
    cloud.points.emplace_back(point.x, point.y, point.z);
    cloud.intensity.push_back(point.intensity);
  }
  return cloud;
}

}  // namespace fathom
