#include "detector/desk_view.h"

#include <fmt/format.h>

#include "detector/cluster.h"

namespace fathom {
namespace {

Points between_heights(const Points& points, double low_m, double high_m) {
  Points result;
  for (const Eigen::Vector3f& point : points)
    if (point.z() > low_m && point.z() <= high_m) result.push_back(point);
  return result;
}

}  // namespace

DeskView view_over(const PlaneFit& desk, Points measured) {
  const Eigen::Isometry3d to_desk = desk_from_camera(desk.plane);
  for (Eigen::Vector3f& point : measured) point = (to_desk * point.cast<double>()).cast<float>();
  return {desk, to_desk, std::move(measured)};
}

std::variant<DeskView, NoDesk> view_of_desk(const Cloud& cloud, const std::optional<DeskPrior>& prior,
                                            const PlaneSearch& search) {
  Points points = finite_points(cloud);
  if (points.size() < 3) return NoDesk{fmt::format("no desk: the cloud has {} measured points", points.size())};
  const std::vector<PlaneFit> planes = find_planes(points, search);
  const std::optional<PlaneFit> desk = choose_desk(planes, prior, search);
  if (!desk)
    return NoDesk{fmt::format("no desk: none of {} planes lies {}", planes.size(),
                              prior ? "where the sensor's height and pitch put it" : "below the camera")};
  return view_over(*desk, std::move(points));
}

std::vector<CupCandidate> cup_candidates(const DeskView& view, const PaperConfig& config) {
  const Points above = between_heights(view.points, config.plane.threshold_m, config.height_max_m);
  std::vector<CupCandidate> candidates;
  for (Points& segment : euclidean_clusters(above, config.cluster_distance_m, config.cluster_points_min))
    candidates.push_back(examine_segment(std::move(segment), config.cup));
  return candidates;
}

}  // namespace fathom
