#include "detector/desk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/median.h"
#include "detector/plane_ransac.h"

namespace fathom {
namespace {

bool agrees(const Plane& plane, const Plane& prior, const DeskSearch& search) {
  return plane.normal.dot(prior.normal) >= std::cos(search.prior_angle_max_rad) &&
         std::abs(plane.offset - prior.offset) <= search.prior_height_max_m;
}

bool below_a_camera_that_looks_ahead_or_down(const Plane& plane) {
  constexpr double kWithinCos = 0.5;  // 60°
  return plane.normal.dot(Eigen::Vector3d(0.0, -1.0, -1.0).normalized()) >= kWithinCos;
}

std::optional<Plane> desk_among(const Points& drawn, const std::optional<DeskPrior>& prior, const DeskSearch& search) {
  std::optional<Plane> expected;
  if (prior) expected = plane_from(*prior);
  const auto may_be = [&](const Plane& plane) { return !expected || agrees(plane, *expected, search); };
  const double fewest = std::max(3.0, search.share_min * static_cast<double>(drawn.size()));
  Points left = drawn;
  std::optional<Plane> any;
  int most = 0;
  for (int round = 0; round < search.planes_max && static_cast<double>(left.size()) >= fewest; ++round) {
    const auto plane = largest_plane(left, search.threshold_m, search.iterations_max, round, may_be);
    const int points = plane ? count_inliers(left, *plane, search.threshold_m) : 0;
    if (points < fewest) break;
    most = std::max(most, points);
    if (expected ? agrees(*plane, *expected, search)
                 : below_a_camera_that_looks_ahead_or_down(*plane) && points >= search.share_of_largest_min * most)
      return plane;
    if (!any) any = plane;
    erase_inliers(left, *plane, search.threshold_m);
  }
  return expected ? std::nullopt : any;
}

/// 2.5 standard deviations of what lies about the plane, by the median: what lies flat on the desk stays out of its fit
/// as far as the noise lets it. At most `most_m`.
double within_noise(const Points& drawn, const Plane& plane, double most_m) {
  std::vector<double> off;
  for (const Eigen::Vector3f& point : drawn)
    if (const double height = std::abs(plane.height_of(point.cast<double>())); height < most_m) off.push_back(height);
  constexpr double kSigmaPerMedian = 1.4826, kDeviations = 2.5;
  return off.empty() ? most_m : std::min(most_m, kDeviations * kSigmaPerMedian * median(std::move(off)));
}

}  // namespace

std::variant<PlaneFit, NoDesk> find_desk(const Points& points, const std::optional<DeskPrior>& prior,
                                         const DeskSearch& search) {
  const Points drawn = draw_points(points, search.draw);
  const std::optional<Plane> desk = desk_among(drawn, prior, search);
  if (!desk) {
    const auto measured = std::count_if(points.begin(), points.end(), [](const auto& p) { return p.allFinite(); });
    return NoDesk{measured < 3
                      ? fmt::format("no desk: the cloud has {} measured points", measured)
                      : fmt::format("no desk: no plane of {:g} % of the points lies {}", 100.0 * search.share_min,
                                    prior ? "where the sensor's height and pitch put it" : "in the cloud")};
  }
  PlaneFit fit = fit_plane(drawn, *desk, search.refine_m);
  constexpr int kRounds = 3;  // each leaves out more of what lies flat: plates read 3 mm high and pull the first fit up
  for (int round = 0; round < kRounds; ++round)
    fit = fit_plane(drawn, fit.plane, within_noise(drawn, fit.plane, search.refine_m));
  fit = fit_plane(points, fit.plane, within_noise(drawn, fit.plane, search.refine_m));
  if (fit.inliers < 3) return NoDesk{"no desk: too few points agree on a plane"};
  fit.inliers = count_inliers(points, fit.plane, search.threshold_m);
  return fit;
}

}  // namespace fathom
