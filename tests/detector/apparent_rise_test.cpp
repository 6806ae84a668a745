// How far a bottom below a clear liquid seems raised: limits, and exact triangulation.
#include "detector/apparent_rise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/pose.h"
#include "detector/plane.h"
#include "theory/triangulation.h"

namespace fathom {
namespace {

constexpr double kIndex = 1.333;

TEST(ApparentRise, StraightDownItIsTheTextbooksAndWithoutRefractionNone) {
  EXPECT_NEAR(apparent_rise(0.030, {0.0, 0.0}, kIndex), 0.030 * (1.0 - 1.0 / kIndex), 1e-15);
  EXPECT_NEAR(apparent_rise(0.030, {0.0, 1.0}, kIndex), 0.030 * (1.0 - 1.0 / kIndex), 1e-15);
  EXPECT_NEAR(apparent_rise(0.030, {0.7, 0.5}, 1.0), 0.0, 1e-15);
  EXPECT_GT(apparent_rise(0.030, {0.7, 0.0}, kIndex), apparent_rise(0.030, {0.5, 0.0}, kIndex));
}

TEST(ApparentRise, AcrossThePlaneOfIncidenceItIsEquation7) {
  for (const double incidence : {0.2, 0.5, 0.8}) {
    const double inside = std::asin(std::sin(incidence) / kIndex);
    EXPECT_NEAR(apparent_rise(0.020, {incidence, 0.0}, kIndex), 0.020 * (1.0 - std::tan(inside) / std::tan(incidence)),
                1e-15);
  }
}

/// The slope of the ray bundle: a beam shifted by a little meets the first one at the inner focus.
TEST(ApparentRise, WithinThePlaneOfIncidenceItIsWhereNeighbouringRaysMeet) {
  constexpr double kFill = 0.020, kStep = 1e-5;
  for (const double incidence : {0.2, 0.5, 0.8}) {
    const auto foot = [&](double angle) { return kFill * std::tan(std::asin(std::sin(angle) / kIndex)); };
    // Air rays through (foot, surface) with slope tan(angle) cross at depth Δfoot / Δtan below the surface.
    const double depth = (foot(incidence + kStep) - foot(incidence - kStep)) /
                         (std::tan(incidence + kStep) - std::tan(incidence - kStep));
    EXPECT_NEAR(apparent_rise(kFill, {incidence, 1.0}, kIndex), kFill - depth, 1e-9);
  }
}

TEST(ApparentRise, IsThatOfExactTriangulationAlsoBesideTheMiddle) {
  constexpr double kBaseline = 0.075, kFill = 0.030, kHeight = 0.65;
  double most_off_equation_7 = 0.0;
  for (const double lateral : {-0.20, -0.10, 0.0, 0.10, 0.20})
    for (const double distance : {0.25, 0.40}) {
      const auto exact = theory::triangulate({.sensor_height = kHeight,
                                              .baseline = kBaseline,
                                              .fill = kFill,
                                              .index = kIndex,
                                              .lateral = lateral,
                                              .distance = distance});
      // The desk's frame has its origin below the camera, at the baseline's left end.
      const Pose to_desk = desk_from_camera(plane_from({kHeight, std::atan2(kHeight, distance)}));
      const Eigen::Vector3d seen(lateral + 0.5 * kBaseline, distance, exact.height);
      const LineOfSight sight = line_of_sight(to_desk, seen, kBaseline);
      EXPECT_NEAR(apparent_rise(kFill, sight, kIndex), exact.height, 5e-5)
          << lateral << " " << distance;  // as promised
      most_off_equation_7 =
          std::max(most_off_equation_7, std::abs(apparent_rise(kFill, {sight.incidence_rad}, kIndex) - exact.height));
    }
  EXPECT_GT(most_off_equation_7, 5e-4);
}

}  // namespace
}  // namespace fathom
