#include "detector/plane.h"

#include <algorithm>
#include <cmath>

#include "detector/plane_ransac.h"

namespace fathom {
namespace {

constexpr double kDeskNormalWithinCos = 0.5;  // 60°

bool may_be_desk(const PlaneFit& fit, const Plane& prior, const PlaneSearch& search) {
  return fit.plane.normal.dot(prior.normal) >= std::cos(search.prior_angle_max_rad) &&
         std::abs(fit.plane.offset - prior.offset) <= search.prior_height_max_m;
}

}  // namespace

Plane plane_from(const DeskPrior& prior) {
  const double horizontal = std::cos(prior.pitch_rad);
  // With roll, "up" turns against the camera's turn about its line of sight.
  return {{-horizontal * std::sin(prior.roll_rad), -horizontal * std::cos(prior.roll_rad), -std::sin(prior.pitch_rad)},
          prior.height_m};
}

double pitch_above(const Plane& plane) { return std::asin(std::clamp(-plane.normal.z(), -1.0, 1.0)); }

double roll_above(const Plane& plane) { return std::atan2(-plane.normal.x(), -plane.normal.y()); }

Eigen::Isometry3d desk_from_camera(const Plane& desk) {
  const Eigen::Vector3d up = desk.normal;
  const auto horizontal = [&](const Eigen::Vector3d& v) -> Eigen::Vector3d { return v - v.dot(up) * up; };
  const Eigen::Vector3d along_sight = horizontal(Eigen::Vector3d::UnitZ());
  // Within 0.06° of straight down the line of sight has no horizontal direction to speak of.
  const Eigen::Vector3d away =
      (along_sight.norm() > 1e-3 ? along_sight : horizontal(-Eigen::Vector3d::UnitY())).normalized();
  Eigen::Matrix3d rotation;
  rotation.row(0) = away.cross(up).transpose();
  rotation.row(1) = away.transpose();
  rotation.row(2) = up.transpose();
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() = rotation;
  result.translation() = Eigen::Vector3d(0.0, 0.0, desk.offset);
  return result;
}

std::vector<PlaneFit> find_planes(const Points& points, const PlaneSearch& search) {
  Points left = points;
  const double fewest = std::max(3.0, search.share_min * static_cast<double>(points.size()));
  const auto any = [](const Plane&) { return true; };
  std::vector<PlaneFit> planes;
  while (static_cast<int>(planes.size()) < search.planes_max && static_cast<double>(left.size()) >= fewest) {
    const auto found = largest_plane(draw_points(left, search.draw), search.threshold_m, search.iterations_max,
                                     static_cast<int>(planes.size()), any);
    if (!found) break;
    const Plane plane = fit_plane(left, *found, search.threshold_m).plane;
    const PlaneFit refined = fit_plane(left, plane, search.threshold_m);
    if (static_cast<double>(refined.inliers) < fewest) break;
    erase_inliers(left, plane, search.threshold_m);
    planes.push_back(refined);
  }
  return planes;
}

std::optional<PlaneFit> choose_desk(const std::vector<PlaneFit>& planes, const std::optional<DeskPrior>& prior,
                                    const PlaneSearch& search) {
  const auto foot = [](const Plane& plane) -> Eigen::Vector3d { return -plane.offset * plane.normal; };
  std::optional<PlaneFit> best;
  for (const PlaneFit& fit : planes) {
    if (prior) {
      const Plane expected = plane_from(*prior);
      if (!may_be_desk(fit, expected, search)) continue;
      const auto distance = [&](const PlaneFit& f) { return (foot(f.plane) - foot(expected)).norm(); };
      if (!best || distance(fit) < distance(*best)) best = fit;
    } else {
      const Eigen::Vector3d diagonal = Eigen::Vector3d(0.0, -1.0, -1.0).normalized();
      if (fit.plane.normal.dot(diagonal) >= kDeskNormalWithinCos && (!best || fit.inliers > best->inliers)) best = fit;
    }
  }
  return best;
}

}  // namespace fathom
