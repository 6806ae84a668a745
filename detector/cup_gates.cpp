#include "detector/cup_gates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/units.h"

namespace fathom {
namespace {

double width_along_desk(const Points& points) {
  constexpr int kAngles = 36;  // every 5°: the largest extent is missed by at most 1 − cos 2.5° = 0.1 %
  double widest = 0.0;
  for (int i = 0; i < kAngles; ++i) {
    const double angle = std::numbers::pi * i / kAngles;
    const Eigen::Vector2f direction = Eigen::Vector2d(std::cos(angle), std::sin(angle)).cast<float>();
    float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
    for (const Eigen::Vector3f& point : points) {
      const float along = direction.dot(point.head<2>());
      low = std::min(low, along);
      high = std::max(high, along);
    }
    widest = std::max(widest, static_cast<double>(high - low));
  }
  return widest;
}

std::vector<Eigen::Vector2d> band_on_desk(const Points& points, const CupGates& gates) {
  std::vector<Eigen::Vector2d> band;
  for (const Eigen::Vector3f& point : points)
    if (point.z() >= gates.band_low_m && point.z() <= gates.band_high_m)
      band.emplace_back(point.head<2>().cast<double>());
  return band;
}

std::string outside(const char* what, double value_m, double low_m, double high_m) {
  return fmt::format("{} {:.1f} mm is outside {:g} to {:g} mm", what, mm_from_metres(value_m), mm_from_metres(low_m),
                     mm_from_metres(high_m));
}

}  // namespace

CupCandidate examine_segment(Points segment, const CupGates& gates) {
  CupCandidate result;
  result.points = std::move(segment);
  result.width_m = width_along_desk(result.points);
  for (const Eigen::Vector3f& point : result.points) result.top_m = std::max<double>(result.top_m, point.z());
  if (result.width_m < gates.width_min_m || result.width_m > gates.width_max_m) {
    result.rejected = outside("width", result.width_m, gates.width_min_m, gates.width_max_m);
    return result;
  }
  if (result.top_m < gates.top_min_m) {
    result.rejected =
        fmt::format("height {:.1f} mm is below {:g} mm", mm_from_metres(result.top_m), mm_from_metres(gates.top_min_m));
    return result;
  }

  const std::vector<Eigen::Vector2d> band = band_on_desk(result.points, gates);
  result.band_points = static_cast<int>(band.size());
  result.circle = fit_circle(band);
  if (!result.circle) {
    result.rejected = fmt::format("no circle through the {} points {:g} to {:g} mm above the desk", band.size(),
                                  mm_from_metres(gates.band_low_m), mm_from_metres(gates.band_high_m));
  } else if (result.circle->rms_m > gates.circle_rms_max_m) {
    result.rejected = outside("circle rms", result.circle->rms_m, 0.0, gates.circle_rms_max_m);
  } else if (result.circle->radius_m < gates.radius_min_m || result.circle->radius_m > gates.radius_max_m) {
    result.rejected = outside("radius", result.circle->radius_m, gates.radius_min_m, gates.radius_max_m);
  }
  return result;
}

}  // namespace fathom
