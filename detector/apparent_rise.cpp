#include "detector/apparent_rise.h"

#include <cmath>

namespace fathom {

LineOfSight line_of_sight(const Eigen::Isometry3d& desk_from_camera, const Eigen::Vector3d& point, double baseline_m) {
  const Eigen::Vector3d baseline = desk_from_camera.linear().col(0);
  const Eigen::Vector3d sight = (point - desk_from_camera.translation() - 0.5 * baseline_m * baseline).normalized();
  const double cosine = -sight.z(), sine = sight.head<2>().norm();
  const Eigen::Vector3d across = baseline - baseline.dot(sight) * sight;
  constexpr double kTiny = 1e-9;  // looking straight down, or along the baseline, no direction is special
  const double share = sine < kTiny || across.norm() < kTiny ? 0.0 : std::pow(across.z() / (sine * across.norm()), 2);
  return {std::atan2(sine, cosine), share};
}

double apparent_rise(double fill_m, const LineOfSight& sight, double index) {
  const double cosine = std::cos(sight.incidence_rad);
  const double below = index * index - 1.0 + cosine * cosine;  // n² − sin²θ
  const double outside = cosine / std::sqrt(below);
  const double inside = outside * std::pow(index * cosine, 2) / below;
  return fill_m * (1.0 - outside * (1.0 - sight.baseline_share_in) - inside * sight.baseline_share_in);
}

}  // namespace fathom
