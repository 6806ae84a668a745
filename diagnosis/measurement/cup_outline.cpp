#include "diagnosis/measurement/cup_outline.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace fathom {
namespace {

constexpr double kGate = 0.012, kNarrowGate = 0.007;  ///< [m]
constexpr double kAboveFill = 0.006;                  ///< [m] a meniscus, the fill's error or half a matcher's window
constexpr double kBehindWall = 0.004;                 ///< [m] half a window across the wall: further in is the inside
constexpr double kCoarse = 0.008;                     ///< [m] between places that are looked at for a cup
constexpr double kNearest = 0.006;                    ///< [m] nearer the fit from the written place says all there is
constexpr double kFarthest = 0.032;                   ///< [m] the bound of cup_placement, and what a desk's error adds

}  // namespace

double inner_wall_above(const CupProfile& cup, double level) {
  constexpr double kBelowRim = 0.035;  // [m] however little is written: notes may be wrong
  return std::max(cup.height() - kBelowRim, level + kAboveFill);
}

OutlineFit::OutlineFit(const LaboratoryRig& rig, const Eigen::Vector2d& axis, double fill)
    : cup_(rig.cup),
      level_(rig.cup.bottom() + fill),
      to_sensor_(-axis.normalized()),
      steepness_(rig.height_m / axis.norm()) {}

void OutlineFit::add(const Eigen::Vector2d& from_axis, double height, double weight) {
  constexpr double kReach = 0.010;  // [m] of a matcher's window across desk and rim
  if (from_axis.norm() < interior_radius(cup_))
    inside_.push_back({static_cast<float>(height), static_cast<float>(weight)});
  if (height < kReach || height > cup_.height() - kReach) return;
  const auto lean = [&](double (CupProfile::*radius)(double) const) {
    constexpr double kSpan = 0.5e-3;  // [m]
    return steepness_ * ((cup_.*radius)(height + kSpan) - (cup_.*radius)(height - kSpan)) / (2.0 * kSpan);
  };
  sensed_.push_back({from_axis, height, weight, cup_.inner_radius(height), cup_.outer_radius(height),
                     lean(&CupProfile::inner_radius), lean(&CupProfile::outer_radius)});
}

/// Nothing of a point that is no wall's, or farther than `gate` [m] from it.
std::optional<OutlineFit::NearWall> OutlineFit::near_wall(const Sensed& sensed, const CupOutline& outline,
                                                          double gate) const {
  constexpr double kFacing = 0.25;  // least cosine between the wall's normal and the sensor's direction
  const Eigen::Vector2d off = sensed.from_axis - outline.off;
  const double distance = off.norm();
  if (!(distance > 0.0)) return std::nullopt;
  const Eigen::Vector2d outward = off / distance;
  const double facing = outward.dot(to_sensor_);
  const bool is_inside = facing - sensed.inner_lean <= -kFacing;
  if (!is_inside && facing - sensed.outer_lean < kFacing) return std::nullopt;
  if (is_inside && sensed.height < inner_from_) return std::nullopt;
  const double excess = distance - outline.wider - (is_inside ? sensed.inner_radius : sensed.outer_radius);
  if (std::abs(excess) > gate) return std::nullopt;
  // Where the sensor hardly sees the outer wall, the liquid behind it may be all there is.
  if (!is_inside && distance < sensed.inner_radius - kBehindWall) return std::nullopt;
  return NearWall{outward, excess, is_inside};
}

/// One step of Gauss and Newton.
std::optional<CupOutline> OutlineFit::step(const CupOutline& from, double gate) const {
  constexpr double kFewestPixels = 60.0;  // on either side
  // Least eigenvalue per pixel: 0.37 of two arcs of 75° to either side, at most 0.033 of what one side shows. There a
  // radius and a place that belong to each other fit alike, and a window's pull on the wall counts six times.
  constexpr double kBothSides = 0.05;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double inner_pixels = 0.0;
  for (const Sensed& sensed : sensed_) {
    const std::optional<NearWall> wall = near_wall(sensed, from, gate);
    if (!wall) continue;
    const Eigen::Vector3d moves(wall->outward.x(), wall->outward.y(), 1.0);
    normal += sensed.weight * moves * moves.transpose();
    right += sensed.weight * wall->excess * moves;
    if (wall->is_inside) inner_pixels += sensed.weight;
  }
  const double pixels = normal(2, 2);
  if (std::min(inner_pixels, pixels - inner_pixels) < kFewestPixels) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(normal);
  if (eigen.eigenvalues()[0] < kBothSides * pixels) return std::nullopt;
  const Eigen::Matrix3d covariance =
      eigen.eigenvectors() * eigen.eigenvalues().cwiseInverse().asDiagonal() * eigen.eigenvectors().transpose();
  const Eigen::Vector3d x = covariance * right;
  return CupOutline{from.off + x.head<2>(), from.wider + x.z(), covariance.diagonal().cwiseInverse()};
}

std::optional<CupOutline> OutlineFit::fit_from(const Eigen::Vector2d& off) const {
  std::optional<CupOutline> outline = step({off, 0.0}, kGate);
  for (int i = 0; i < 2 && outline; ++i) outline = step(*outline, kNarrowGate);
  return outline;
}

/// [m] of points near the walls off these: 2 mm of a wall's, 4 mm of what happens to lie there, even within the gate.
double OutlineFit::scatter(const CupOutline& outline) const {
  double squares = 0.0, pixels = 0.0;
  for (const Sensed& sensed : sensed_)
    if (const std::optional<NearWall> wall = near_wall(sensed, outline, kNarrowGate))
      squares += sensed.weight * wall->excess * wall->excess, pixels += sensed.weight;
  return std::sqrt(squares / pixels);
}

/// Pixels on that wall of a cup there which has fewer: a liquid or one wall alone make many on the other.
double OutlineFit::weaker_wall(const Eigen::Vector2d& off) const {
  double inner = 0.0, outer = 0.0;
  for (const Sensed& sensed : sensed_)
    if (const std::optional<NearWall> wall = near_wall(sensed, {off, 0.0}, kCoarse)) {
      const double share = wall->excess / kCoarse;
      (wall->is_inside ? inner : outer) += sensed.weight * (1.0 - share * share);
    }
  return std::min(inner, outer);
}

/// Where most of a cup's walls lie, to 8 mm, which the fit's first gate spans.
Eigen::Vector2d OutlineFit::place_of_walls() const {
  Eigen::Vector2d best = Eigen::Vector2d::Zero();
  double most = 0.0;
  constexpr int kSteps = static_cast<int>(kFarthest / kCoarse);
  for (int x = -kSteps; x <= kSteps; ++x)
    for (int y = -kSteps; y <= kSteps; ++y) {
      const Eigen::Vector2d off = kCoarse * Eigen::Vector2d(x, y);
      if (off.norm() > kFarthest) continue;
      const double pixels = weaker_wall(off);
      if (pixels > most) most = pixels, best = off;
    }
  return best;
}

void OutlineFit::leave_out_liquid() {
  if (!inside_.empty()) level_ = std::max<double>(level_, middle_height(inside_));
  inner_from_ = inner_wall_above(cup_, level_);
  std::erase_if(sensed_, [&](const Sensed& one) { return std::abs(one.height - level_) < kAboveFill; });
}

std::optional<CupOutline> OutlineFit::solve() {
  leave_out_liquid();
  constexpr double kSharp = 0.003, kOwnWidth = 0.002;  // [m]
  const std::optional<CupOutline> as_written = fit_from(Eigen::Vector2d::Zero());
  const double scattered = as_written ? std::min(scatter(*as_written), kSharp) : kSharp;
  const bool is_near = as_written && as_written->off.norm() < kNearest;
  if (is_near && scattered < kSharp && std::abs(as_written->wider) < kOwnWidth) return as_written;
  const std::optional<CupOutline> beside = fit_from(place_of_walls());
  if (!beside || beside->off.norm() < kNearest || beside->off.norm() > kFarthest) return as_written;
  return scatter(*beside) < scattered ? beside : as_written;
}

double OutlineFit::reach() const { return kFarthest + cup_.widest() + kCoarse; }

}  // namespace fathom
