#include "diagnosis/measurement/cup_outline.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace fathom {

OutlineFit::OutlineFit(const LaboratoryRig& rig, const Eigen::Vector2d& axis)
    : inner_radius_(rig.inner_radius_m),
      outer_radius_(rig.outer_radius_m),
      rim_(rig.cup_height_m),
      to_sensor_(-axis.normalized()) {}

void OutlineFit::add(const Eigen::Vector2d& from_axis, double height, double weight) {
  constexpr double kReach = 0.010;       // [m] of a matcher's window across desk and rim
  constexpr double kInnerBelow = 0.035;  // [m] the rim: what stands in a cup is deeper
  constexpr double kFacing = 0.25;       // least cosine between the wall's normal and the sensor's direction
  constexpr double kGate = 0.012;        // [m]
  const double highest = rim_ - kReach;
  if (height < kReach || height > highest) return;
  const double distance = from_axis.norm();
  if (!(distance > 0.0)) return;
  const Eigen::Vector2d outward = from_axis / distance;
  const double facing = outward.dot(to_sensor_);
  if (std::abs(facing) < kFacing) return;
  const bool is_inside = facing < 0.0;
  if (is_inside && height < rim_ - kInnerBelow) return;
  const double excess = distance - (is_inside ? inner_radius_ : outer_radius_);
  if (std::abs(excess) > kGate) return;
  const Eigen::Vector3d moves(outward.x(), outward.y(), 1.0);
  normal_ += weight * moves * moves.transpose();
  right_ += weight * excess * moves;
}

std::optional<CupOutline> OutlineFit::solve() const {
  constexpr double kFewestPixels = 60.0;
  constexpr double kShortArc =
      0.02;  // least eigenvalue per pixel: 0.37 of two arcs of 75° to either side, 0.025 of one of 70°
  const double pixels = normal_(2, 2);
  if (pixels < kFewestPixels) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(normal_);
  if (eigen.eigenvalues()[0] < kShortArc * pixels) return std::nullopt;
  const Eigen::Vector3d x = eigen.eigenvectors() * eigen.eigenvalues().cwiseInverse().asDiagonal() *
                            eigen.eigenvectors().transpose() * right_;
  return CupOutline{x.head<2>(), x.z()};
}

}  // namespace fathom
