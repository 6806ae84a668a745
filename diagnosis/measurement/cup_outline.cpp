#include "diagnosis/measurement/cup_outline.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace fathom {

OutlineFit::OutlineFit(const LaboratoryRig& rig, const Eigen::Vector2d& axis)
    : inner_radius_(rig.inner_radius_m),
      outer_radius_(rig.outer_radius_m),
      rim_(rig.cup_height_m),
      to_sensor_(-axis.normalized()) {}

void OutlineFit::add(const Eigen::Vector2d& from_axis, double height, double weight) {
  constexpr double kReach = 0.010;  // [m] of a matcher's window across desk and rim
  if (height >= kReach && height <= rim_ - kReach) sensed_.push_back({from_axis, height, weight});
}

/// One step of Gauss and Newton.
std::optional<CupOutline> OutlineFit::step(const CupOutline& from, double gate) const {
  constexpr double kInnerBelow = 0.035;   // [m] the rim: what stands in a cup is deeper
  constexpr double kFacing = 0.25;        // least cosine between the wall's normal and the sensor's direction
  constexpr double kFewestPixels = 60.0;  // on either side
  // Least eigenvalue per pixel: 0.37 of two arcs of 75° to either side, at most 0.033 of what one side shows. There a
  // radius and a place that belong to each other fit alike, and a window's pull on the wall counts six times.
  constexpr double kBothSides = 0.05;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double inner_pixels = 0.0;
  for (const Sensed& sensed : sensed_) {
    const Eigen::Vector2d off = sensed.from_axis - from.off;
    const double distance = off.norm();
    if (!(distance > 0.0)) continue;
    const Eigen::Vector2d outward = off / distance;
    const double facing = outward.dot(to_sensor_);
    if (std::abs(facing) < kFacing) continue;
    const bool is_inside = facing < 0.0;
    if (is_inside && sensed.height < rim_ - kInnerBelow) continue;
    const double excess = distance - from.wider - (is_inside ? inner_radius_ : outer_radius_);
    if (std::abs(excess) > gate) continue;
    const Eigen::Vector3d moves(outward.x(), outward.y(), 1.0);
    normal += sensed.weight * moves * moves.transpose();
    right += sensed.weight * excess * moves;
    if (is_inside) inner_pixels += sensed.weight;
  }
  const double pixels = normal(2, 2);
  if (std::min(inner_pixels, pixels - inner_pixels) < kFewestPixels) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(normal);
  if (eigen.eigenvalues()[0] < kBothSides * pixels) return std::nullopt;
  const Eigen::Vector3d x =
      eigen.eigenvectors() * eigen.eigenvalues().cwiseInverse().asDiagonal() * eigen.eigenvectors().transpose() * right;
  return CupOutline{from.off + x.head<2>(), from.wider + x.z()};
}

std::optional<CupOutline> OutlineFit::solve() const {
  constexpr double kGate = 0.012, kNarrowGate = 0.007;  // [m]
  std::optional<CupOutline> outline = step({Eigen::Vector2d::Zero(), 0.0}, kGate);
  for (int i = 0; i < 2 && outline; ++i) outline = step(*outline, kNarrowGate);
  return outline;
}

}  // namespace fathom
