#include "detector/cup_gates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace fathom {
namespace {

/// A wall of the given radius and height, one point per millimetre of height and 3 degrees.
Points tube(double radius, double height) {
  Points points;
  for (int mm = 11; mm <= static_cast<int>(std::lround(height * 1000.0)); ++mm)
    for (int degree = 0; degree < 360; degree += 3) {
      const double angle = degree * std::numbers::pi / 180.0;
      points.push_back(
          Eigen::Vector3d(radius * std::cos(angle), 0.4 + radius * std::sin(angle), 0.001 * mm).cast<float>());
    }
  return points;
}

TEST(CupGates, AcceptTubesBetweenThePrintedRadii) {
  for (const double radius : {0.021, 0.043, 0.059}) {
    const CupCandidate candidate = examine_segment(tube(radius, 0.087), {});
    EXPECT_EQ(candidate.rejected, "");
    ASSERT_TRUE(candidate.circle);
    EXPECT_NEAR(candidate.circle->radius_m, radius, 1e-6);               // single-precision points
    EXPECT_NEAR(candidate.width_m, 2.0 * radius, 0.001 * 2.0 * radius);  // directions every 5°
    EXPECT_NEAR(candidate.top_m, 0.087, 1e-6);
    EXPECT_GE(candidate.band_points, 9 * 120);  // the rows at 40 and 50 mm lie on the edge
    EXPECT_LE(candidate.band_points, 11 * 120);
  }
}

TEST(CupGates, RejectAndSayWhy) {
  EXPECT_EQ(examine_segment(tube(0.012, 0.087), {}).rejected, "width 24.0 mm is outside 30 to 170 mm");
  EXPECT_EQ(examine_segment(tube(0.018, 0.087), {}).rejected, "radius 18.0 mm is outside 20 to 60 mm");
  EXPECT_EQ(examine_segment(tube(0.065, 0.087), {}).rejected, "radius 65.0 mm is outside 20 to 60 mm");
  EXPECT_EQ(examine_segment(tube(0.090, 0.087), {}).rejected, "width 180.0 mm is outside 30 to 170 mm");
  EXPECT_EQ(examine_segment(tube(0.043, 0.030), {}).rejected, "height 30.0 mm is below 40 mm");
  Points hollow;
  for (const Eigen::Vector3f& point : tube(0.043, 0.087))
    if (point.z() < 0.038f || point.z() > 0.052f) hollow.push_back(point);
  EXPECT_EQ(examine_segment(hollow, {}).rejected, "no circle through the 0 points 40 to 50 mm above the desk");
}

TEST(CupGates, ThePrintedRmsLimitRejectsNothingThatTheRadiusAccepts) {
  // Half of the points at the centre and half on a rim of 84 mm: about as far from a circle as a radius of 60 mm can
  // be.
  Points scattered = tube(0.084, 0.087);
  const std::size_t rim = scattered.size();
  for (std::size_t i = 0; i < rim; ++i) scattered.emplace_back(0.0f, 0.4f, scattered[i].z());
  const CupCandidate candidate = examine_segment(scattered, {});
  ASSERT_TRUE(candidate.circle);
  EXPECT_LT(candidate.circle->radius_m, 0.060);
  EXPECT_GT(candidate.circle->rms_m, 0.040);  // only such a thing reaches the limit
  Points half = tube(0.084, 0.087);
  for (std::size_t i = 0; i < rim; i += 2)
    half[i].head<2>() = Eigen::Vector2f(0.0f, 0.4f) + 0.3f * (half[i].head<2>() - Eigen::Vector2f(0.0f, 0.4f));
  EXPECT_LT(examine_segment(half, {}).circle->rms_m, 0.040);
}

}  // namespace
}  // namespace fathom
