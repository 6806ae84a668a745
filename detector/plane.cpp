#include "detector/plane.h"

#include <pcl/sample_consensus/ransac.h>
#include <pcl/sample_consensus/sac_model_plane.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "detector/pcl_points.h"
#include "detector/quiet_pcl.h"

namespace fathom {
namespace {

using PlaneModel = pcl::SampleConsensusModelPlane<pcl::PointXYZ>;

constexpr double kDeskNormalWithinCos = 0.5;  // 60°

Plane facing_camera(Plane plane) {
  if (plane.offset < 0.0) return {-plane.normal, -plane.offset};
  return plane;
}

/// Total least squares: the direction of least scatter about the mean.
Plane least_squares_plane(const Points& points, const pcl::Indices& indices) {
  assert(indices.size() >= 3);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const int i : indices) mean += points[i].cast<double>();
  mean /= static_cast<double>(indices.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const int i : indices) {
    const Eigen::Vector3d offset = points[i].cast<double>() - mean;
    scatter += offset * offset.transpose();
  }
  const Eigen::Vector3d normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors().col(0);
  return facing_camera({normal, -normal.dot(mean)});
}

/// Splits `indices` into those within the threshold of the plane, which are returned, and the others, which stay.
pcl::Indices take_inliers(const Points& points, const Plane& plane, double threshold_m, pcl::Indices& indices) {
  pcl::Indices inliers, others;
  for (const int i : indices)
    (std::abs(plane.height_of(points[i].cast<double>())) <= threshold_m ? inliers : others).push_back(i);
  indices = std::move(others);
  return inliers;
}

double rms_distance(const Points& points, const pcl::Indices& indices, const Plane& plane) {
  double squares = 0.0;
  for (const int i : indices) squares += std::pow(plane.height_of(points[i].cast<double>()), 2);
  return std::sqrt(squares / static_cast<double>(indices.size()));
}

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
  const QuietPcl quiet;
  const auto cloud = pcl_cloud(points);
  pcl::Indices left(points.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = static_cast<int>(i);
  const double fewest = std::max(3.0, search.share_min * static_cast<double>(points.size()));

  std::vector<PlaneFit> planes;
  while (static_cast<int>(planes.size()) < search.planes_max && static_cast<double>(left.size()) >= fewest) {
    const auto model = std::make_shared<PlaneModel>(cloud, left);  // PCL's default seed is fixed
    pcl::RandomSampleConsensus<pcl::PointXYZ> ransac(model, search.threshold_m);
    ransac.setMaxIterations(search.iterations_max);
    if (!ransac.computeModel()) break;
    pcl::Indices sample_inliers;
    ransac.getInliers(sample_inliers);
    if (static_cast<double>(sample_inliers.size()) < fewest) break;

    const Plane plane = least_squares_plane(points, sample_inliers);
    const pcl::Indices inliers = take_inliers(points, plane, search.threshold_m, left);
    if (static_cast<double>(inliers.size()) < fewest) break;
    const Plane refined = least_squares_plane(points, inliers);
    planes.push_back({refined, static_cast<int>(inliers.size()), rms_distance(points, inliers, refined)});
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
