#include "detector/cone.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "detector/depth_noise.h"

namespace fathom {
namespace {

constexpr double kLeanSigma = 0.15;  // cups lean 0 to 10°; where the points span no height, this decides

}  // namespace

std::optional<ConeFit> fit_cone(const Points& points, WallCone cone, double tolerance_m) {
  ConeFit fit{};
  constexpr int kSteps = 6;  // each halves the tolerance's share of outliers; the fit itself needs three
  for (int step = 0; step < kSteps; ++step) {
    // A slab's circle knows no lean: the first step lets in what a lean of 10° puts 30 mm above and below.
    const double within = step == 0 ? 2.0 * tolerance_m : tolerance_m;
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    double squares = 0.0;
    int count = 0;
    for (const Eigen::Vector3f& point : points) {
      const Eigen::Vector2d v = point.head<2>().cast<double>() - cone.center;
      const double distance = v.norm(), above = point.z() - kWallHeight;
      const double off = distance - cone.radius_at(point.z());
      if (std::abs(off) > within || distance == 0.0) continue;
      const Eigen::Vector4d slope(-v.x() / distance, -v.y() / distance, -1.0, -above);
      normal += slope * slope.transpose();
      right += slope * off;
      squares += off * off;
      ++count;
    }
    if (count < 8) return std::nullopt;
    const double variance = std::max(squares / count, 1e-10);
    const double upright = variance * kPointsPerIndependent / (kLeanSigma * kLeanSigma);
    normal(3, 3) += upright;
    right(3) += upright * cone.lean;
    const Eigen::LDLT<Eigen::Matrix4d> solver(normal);
    if (solver.info() != Eigen::Success || !(solver.rcond() > 1e-12)) return std::nullopt;
    const Eigen::Vector4d change = solver.solve(-right);
    cone.center += change.head<2>();
    cone.radius_m += change(2);
    cone.lean += change(3);
    if (!(cone.radius_m > 0.0) || !cone.center.allFinite()) return std::nullopt;
    fit = {cone, solver.solve(Eigen::Matrix4d::Identity()) * variance * kPointsPerIndependent, std::sqrt(variance),
           count};
  }
  return fit;
}

}  // namespace fathom
