#include "theory/triangulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "theory/raised_bottom.h"

namespace fathom::theory {
namespace triangulation_test {

constexpr double kDeg = std::numbers::pi / 180.0;
// Z = b / disparity turns a rounding of the disparity (1e-16) into Z² / b times as much, here 1e-15 m; 10 of them.
constexpr double kRounding = 1e-14;

TriangulationSetup paper_setup(double fill, double distance, double lateral = 0.0) {
  return {.fill = fill, .lateral = lateral, .distance = distance};
}

TEST(Triangulation, KnownHeights) {
  // To the printed digits.
  EXPECT_NEAR(triangulate(paper_setup(0.030, 0.4)).height * 1e3, 9.210, 0.0005);
  EXPECT_NEAR(triangulate(paper_setup(0.030, 0.6)).height * 1e3, 10.889, 0.0005);
}

// The middle ray between camera and projector meets the surface at incidence A after 600 mm, 50 mm of water below.
TEST(Triangulation, KnownApparentDepthsOfTwoRays) {
  const std::vector<std::pair<double, double>> printed{{0.0, 0.75239}, {45.0, 0.62832}, {60.0, 0.49592}};
  constexpr double kRange = 0.600, kDepth = 0.050, kIndex = 1.3281;
  for (const auto& [deg, ratio] : printed) {
    const double angle = deg * kDeg;
    const double under_water = kDepth * std::tan(refraction_angle(angle, kIndex));
    const TriangulationSetup setup{.sensor_height = kRange * std::cos(angle) + kDepth,
                                   .fill = kDepth,
                                   .index = kIndex,
                                   .distance = kRange * std::sin(angle) + under_water};
    EXPECT_NEAR(1.0 - triangulate(setup).height / kDepth, ratio, 0.5e-5) << deg << " deg";
  }
}

TEST(Triangulation, MeasuresTheTrueBottomWithoutRefraction) {
  for (const double lateral : {-0.2, 0.0, 0.13}) {
    TriangulationSetup setup = paper_setup(0.05, 0.4, lateral);
    setup.index = 1.0;
    const Triangulation result = triangulate(setup);
    EXPECT_LT((result.measured - Eigen::Vector3d(lateral, 0.4, 0.0)).norm(), kRounding);
    // Two image coordinates of order 1, in pixels of 570.
    EXPECT_NEAR(result.epipolar_mismatch_px, 0.0, 1e-12);
  }
}

TEST(Triangulation, MeasuresTheTrueBottomOfAnEmptyCup) {
  const Triangulation result = triangulate(paper_setup(0.0, 0.4, 0.1));
  EXPECT_LT((result.measured - Eigen::Vector3d(0.1, 0.4, 0.0)).norm(), kRounding);
  EXPECT_NEAR(triangulate(paper_setup(1e-9, 0.4, 0.1)).height, 0.0, 1e-9);
}

TEST(Triangulation, RisesWithIncidenceDepthAndIndex) {
  double before = 0.0;
  for (double distance = 0.1; distance < 2.0; distance += 0.1) {
    const double height = triangulate(paper_setup(0.03, distance)).height;
    EXPECT_GT(height, before) << "distance " << distance;
    before = height;
  }
  before = 0.0;
  for (double fill = 0.001; fill < 0.2; fill += 0.001) {
    const double height = triangulate(paper_setup(fill, 0.4, 0.1)).height;
    EXPECT_GT(height, before) << "fill " << fill;
    before = height;
  }
  before = 0.0;
  for (double index = 1.01; index < 2.0; index += 0.01) {
    TriangulationSetup setup = paper_setup(0.03, 0.4, 0.1);
    setup.index = index;
    const double height = triangulate(setup).height;
    EXPECT_GT(height, before) << "index " << index;
    before = height;
  }
}

TEST(Triangulation, IsEquation3AtTheTrueIncidenceOnTheBisector) {
  for (const double baseline : {0.300, 0.075, 0.001})
    for (const double distance : {0.0, 0.2, 0.6}) {
      TriangulationSetup setup = paper_setup(0.03, distance);
      setup.baseline = baseline;
      const Triangulation result = triangulate(setup);
      // 1e-16 Z² / b with b down to 1 mm.
      EXPECT_NEAR(result.height, raised_height(0.03, result.incidence_camera, setup.index), 1e-12);
    }
}

TEST(Triangulation, ApproachesOneRayAsTheBaselineVanishes) {
  // A single ray with 30 deg at the surface, 0.6 m above it.
  const double distance = 0.6 * std::tan(30.0 * kDeg) + 0.05 * std::tan(refraction_angle(30.0 * kDeg, 1.333));
  TriangulationSetup setup{.sensor_height = 0.65, .fill = 0.05, .distance = distance};
  const double one_ray = raised_height(0.05, 30.0 * kDeg, 1.333);
  for (const double baseline : {0.075, 0.0075, 0.00075}) {
    setup.baseline = baseline;
    // The difference is of second order in the half baseline over the range: below w (b / 2 H)².
    const double bound = 0.05 * std::pow(baseline / 1.2, 2) + 1e-12;
    EXPECT_NEAR(triangulate(setup).height, one_ray, bound);
  }
}

TEST(Triangulation, RaysMeetOnTheBisector) {
  for (const double distance : {0.0, 0.2, 0.6}) {
    const Triangulation result = triangulate(paper_setup(0.03, distance));
    EXPECT_EQ(result.epipolar_mismatch_px, 0.0);
    EXPECT_EQ(result.incidence_camera, result.incidence_projector);
    EXPECT_NEAR(result.measured.x(), 0.0, kRounding);
    EXPECT_NEAR(result.measured.y(), distance, kRounding);  // straight above the bottom point
  }
}

TEST(Triangulation, RaysAreSkewOffTheBisector) {
  const Triangulation right = triangulate(paper_setup(0.03, 0.4, 0.1));
  EXPECT_GT(right.incidence_camera, right.incidence_projector + 0.5 * kDeg);
  EXPECT_GT(std::abs(right.epipolar_mismatch_px), 0.01);
  EXPECT_GT(right.height, triangulate(paper_setup(0.03, 0.4)).height);
}

// Mirroring the point swaps camera and projector: the same disparity, and the depth is laid along the other ray.
TEST(Triangulation, MirrorSwapsCameraAndProjector) {
  for (const double lateral : {0.02, 0.1, 0.3}) {
    TriangulationSetup setup = paper_setup(0.04, 0.45, lateral);
    setup.pitch = 50.0 * kDeg;
    const Triangulation right = triangulate(setup);
    setup.lateral = -lateral;
    const Triangulation left = triangulate(setup);
    EXPECT_NEAR(right.incidence_camera, left.incidence_projector, 1e-15);
    EXPECT_NEAR(right.incidence_projector, left.incidence_camera, 1e-15);
    EXPECT_NEAR(right.disparity_px, left.disparity_px, 1e-11);  // 570 px of image coordinates rounded at 1e-16
    EXPECT_NEAR(right.epipolar_mismatch_px, -left.epipolar_mismatch_px, 1e-11);
    const double depth = setup.focal_px * setup.baseline / right.disparity_px;
    const double across = depth * right.epipolar_mismatch_px / setup.focal_px;
    EXPECT_NEAR(left.height - right.height, across * std::cos(*setup.pitch), kRounding);
  }
}

TEST(Triangulation, DoesNotDependOnPitchOnTheBisector) {
  TriangulationSetup setup = paper_setup(0.03, 0.4);
  const double height = triangulate(setup).height;
  for (const double deg : {20.0, 45.0, 90.0}) {
    setup.pitch = deg * kDeg;
    EXPECT_NEAR(triangulate(setup).height, height, kRounding);
  }
}

TEST(Triangulation, AimsAtThePointUnlessToldOtherwise) {
  TriangulationSetup setup = paper_setup(0.03, 0.4, 0.2);
  const Triangulation aimed = triangulate(setup);
  setup.pitch = std::atan2(0.65, 0.4);
  EXPECT_EQ(aimed.height, triangulate(setup).height);
  setup.pitch = 90.0 * kDeg;
  EXPECT_NE(aimed.height, triangulate(setup).height);
}

TEST(Triangulation, FillReturnsFromItsHeight) {
  for (const double lateral : {-0.15, 0.0, 0.1})
    for (const double fill : {1e-4, 0.01, 0.03, 0.08}) {
      const TriangulationSetup setup = paper_setup(fill, 0.4, lateral);
      const double height = triangulate(setup).height;
      // The slope dm / dw is about 0.3.
      EXPECT_NEAR(fill_from_height(height, setup, 0.08).value(), fill, 4 * kRounding);
    }
}

TEST(Triangulation, NoFillExplainsAnImpossibleHeight) {
  const TriangulationSetup setup = paper_setup(0.0, 0.4);
  EXPECT_FALSE(fill_from_height(-0.001, setup, 0.08));
  EXPECT_FALSE(fill_from_height(0.0, setup, 0.08));
  EXPECT_FALSE(fill_from_height(0.05, setup, 0.08));  // a full cup of 80 mm shows its bottom at 25 mm
  EXPECT_FALSE(fill_from_height(std::nan(""), setup, 0.08));
  TriangulationSetup air = setup;
  air.index = 1.0;
  EXPECT_FALSE(fill_from_height(1e-17, air, 0.08));
}

TEST(Triangulation, RefusesNonsense) {
  const TriangulationSetup good = paper_setup(0.03, 0.4);
  const auto refuses = [&good](auto spoil) {
    TriangulationSetup setup = good;
    spoil(setup);
    EXPECT_THROW(triangulate(setup), std::invalid_argument);
  };
  refuses([](TriangulationSetup& s) { s.index = 0.99; });
  refuses([](TriangulationSetup& s) { s.index = std::numeric_limits<double>::quiet_NaN(); });
  refuses([](TriangulationSetup& s) { s.fill = -0.001; });
  refuses([](TriangulationSetup& s) { s.sensor_height = s.fill; });
  refuses([](TriangulationSetup& s) { s.baseline = 0.0; });
  refuses([](TriangulationSetup& s) { s.focal_px = 0.0; });
  refuses([](TriangulationSetup& s) { s.distance = std::numeric_limits<double>::infinity(); });
  refuses([](TriangulationSetup& s) { s.pitch = -60.0 * kDeg; });  // looks at the ceiling
  EXPECT_THROW(fill_from_height(0.01, good, 0.65), std::invalid_argument);
  EXPECT_THROW(fill_from_height(0.01, good, 0.0), std::invalid_argument);
}

}  // namespace triangulation_test
}  // namespace fathom::theory
