// The one path through a flat surface, and how it spreads light.
#include "sim/optics/flat_refraction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.h"
#include "theory/triangulation.h"

namespace fathom {
namespace flat_refraction_test {

constexpr double kWater = 1.3281;

TEST(FlatRefraction, CrossingObeysSnellsLaw) {
  Rng rng(1);
  for (int i = 0; i < 2000; ++i) {
    const double height = std::exp(rng.uniform() * 7.0 - 4.0), depth = std::exp(rng.uniform() * 7.0 - 6.0);
    const double separation = 3.0 * rng.uniform(), n_below = 1.0 + rng.uniform();
    const FlatCrossing crossing = cross_flat_interface(height, depth, separation, 1.0, n_below);
    // Promised: 1e-15, or what a rounding of the offset changes the two sines by.
    const double of_offset = 4e-16 * separation * (1.0 / height + 1.0 / depth);
    EXPECT_NEAR(crossing.sin_above, n_below * crossing.sin_below, 1e-15 + of_offset);
    EXPECT_GE(crossing.offset, 0.0);
    EXPECT_LE(crossing.offset, separation);
  }
}

TEST(FlatRefraction, ThePathIsTheSameFromBothEnds) {
  const FlatCrossing down = cross_flat_interface(0.6, 0.03, 0.4, 1.0, kWater);
  const FlatCrossing up = cross_flat_interface(0.03, 0.6, 0.4, kWater, 1.0);
  EXPECT_NEAR(down.offset + up.offset, 0.4, 1e-15);  // roundings of numbers below 1
  EXPECT_NEAR(down.sin_above, up.sin_below, 1e-15);
  EXPECT_NEAR(down.sin_below, up.sin_above, 1e-15);
}

TEST(FlatRefraction, NoSeparationMeansStraightDown) {
  const FlatCrossing crossing = cross_flat_interface(0.6, 0.03, 0.0, 1.0, kWater);
  EXPECT_EQ(crossing.offset, 0.0);
  EXPECT_EQ(crossing.sin_above, 0.0);
  EXPECT_EQ(crossing.sin_below, 0.0);
}

TEST(FlatRefraction, EqualIndicesGiveTheStraightLine) {
  const FlatCrossing crossing = cross_flat_interface(0.6, 0.03, 0.42, 1.33, 1.33);
  EXPECT_NEAR(crossing.offset, 0.42 * 0.6 / 0.63, 1e-15);  // one rounding or two
  EXPECT_NEAR(crossing.sin_above, 0.42 / std::hypot(0.42, 0.63), 1e-15);
}

TEST(FlatRefraction, AgreesWithTheTheorysOwnSolution) {
  for (const double fill : {0.010, 0.020, 0.030})
    for (const double distance : {0.2, 0.4, 0.6}) {
      const theory::Triangulation exact =
          theory::triangulate({.fill = fill, .index = kWater, .lateral = 0.013, .distance = distance});
      const double separation = std::hypot(distance, 0.013 + 0.0375);
      const FlatCrossing crossing = cross_flat_interface(0.650 - fill, fill, separation, 1.0, kWater);
      EXPECT_NEAR(crossing.sin_above, std::sin(exact.incidence_camera), 1e-14);  // two Newton iterations, two roundings
    }
}

/// Horizontal distance reached from height above to depth below by a ray that leaves at `angle` from the vertical.
double reach(double angle, double height, double depth, double n) {
  return height * std::tan(angle) + depth * std::tan(std::asin(std::sin(angle) / n));
}

TEST(FlatRefraction, SpreadingIsTheAreaOfANarrowBundle) {
  const double height = 0.62, depth = 0.03;
  for (const double separation : {1e-6, 0.05, 0.3, 0.6, 1.5}) {
    const FlatCrossing crossing = cross_flat_interface(height, depth, separation, 1.0, kWater);
    const double angle = std::asin(crossing.sin_above), step = 1e-4;
    // In the plane of incidence the bundle opens by dθ; across it by sin θ dφ, while the landing point moves by r dφ.
    const double along =
        (reach(angle + step, height, depth, kWater) - reach(angle - step, height, depth, kWater)) / (2.0 * step);
    const double across = separation / crossing.sin_above;
    const double cos_below = std::sqrt(1.0 - crossing.sin_below * crossing.sin_below);
    const double expected = 1.0 / (along * across * cos_below);
    // Central differences err by step²/6 · r'''/r', below 1e-7 at these angles.
    EXPECT_NEAR(flat_spreading(crossing, height, depth, 1.0, kWater) / expected, 1.0, 1e-6) << separation;
  }
}

TEST(FlatRefraction, WithoutAStepOfIndexLightSpreadsByTheInverseSquare) {
  for (const double separation : {0.0, 0.2, 0.9}) {
    const FlatCrossing crossing = cross_flat_interface(0.6, 0.05, separation, 1.2, 1.2);
    const double squared = separation * separation + 0.65 * 0.65;
    EXPECT_NEAR(flat_spreading(crossing, 0.6, 0.05, 1.2, 1.2) * squared, 1.0, 1e-14);  // about ten roundings
  }
}

TEST(FlatRefraction, StraightDownTheBottomIsLitAsIfItWereAtItsApparentDepth) {
  const FlatCrossing crossing = cross_flat_interface(0.6, 0.04, 0.0, 1.0, kWater);
  const double apparent = 0.6 + 0.04 / kWater;
  EXPECT_NEAR(flat_spreading(crossing, 0.6, 0.04, 1.0, kWater) * apparent * apparent, 1.0, 1e-14);  // roundings
}

}  // namespace flat_refraction_test
}  // namespace fathom
