// The error of a mean height is read from the desk, whatever the sensor's errors have in common.
#include "detector/mean_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.h"
#include "detector/depth_noise.h"

namespace fathom {
namespace {

constexpr double kCamera = 0.7;  // [m] above the desk

/// A desk of points 2 mm apart about 0.4 m ahead. Errors have `own` of each point and `shared` by squares of 40 mm, at
/// a range of 1 m.
Points desk(double own_m, double shared_m) {
  Points points;
  for (int row = 0; row < 400; ++row)
    for (int column = -200; column < 200; ++column) {
      const double x = 0.002 * column + 0.001, y = 0.002 * row + 0.001;
      const auto square = static_cast<std::uint64_t>((row / 20) * 1000 + column / 20 + 500);
      const double error = own_m * Rng(1, row, column + 1000).normal() + shared_m * Rng(2, square).normal();
      const double per_depth = kCamera * std::hypot(x, y, kCamera);
      points.emplace_back(static_cast<float>(x), static_cast<float>(y), static_cast<float>(error * per_depth));
    }
  return points;
}

const Eigen::Vector3d kPlace(0.0, 0.4, 0.01);

double scale() { return (kCamera - kPlace.z()) * std::hypot(0.4, kCamera - kPlace.z()); }

TEST(MeanError, OfIndependentPointsFallsWithTheRootOfTheirNumber) {
  const MeanError errors(desk(0.001, 0.0), kCamera);
  // Patches hold 100, 225, 400 and 900 points; a class takes in twice as many as its least, and beside walls it is up
  // to twice as much.
  const double many = errors.of_height(900, kPlace), few = errors.of_height(100, kPlace);
  EXPECT_GT(many, 0.001 / 30.0 * scale());
  EXPECT_LT(many, 2.0 * 0.001 / 30.0 * scale());
  EXPECT_GT(few, 0.001 / 10.0 * scale());
  EXPECT_LT(few, 2.5 * 0.001 / 10.0 * scale());
}

TEST(MeanError, OfWhatNeighboursShareDoesNot) {
  const MeanError errors(desk(0.001, 0.0007), kCamera);
  EXPECT_GT(errors.of_height(400, kPlace), 0.0007 * 0.8 * scale());  // 400 squares: within a tenth, or two
  EXPECT_LT(errors.of_height(400, kPlace), 0.0007 * 2.0 * scale());
}

TEST(MeanError, GrowsWithTheSquareOfTheRangeAndShrinksWithIncidence) {
  const MeanError errors(desk(0.001, 0.0), kCamera);
  const double near = errors.of_height(200, {0.0, 0.0, 0.0}), aside = errors.of_height(200, {0.0, kCamera, 0.0});
  EXPECT_NEAR(aside / near, std::sqrt(2.0), 1e-12);  // twice the depth's error, at 45°
}

TEST(MeanError, IsNeverNothing) {
  EXPECT_GE(MeanError(desk(0.0, 0.0), kCamera).of_height(100000, kPlace), 1e-5);  // a hundredth of a millimetre
}

TEST(MeanError, WithoutABareDeskItIsWhatRecordedDesksShow) {
  EXPECT_NEAR(MeanError({}, kCamera).of_height(100000, kPlace), mean_error_m(1.0) * scale(), 0.1 * mean_error_m(1.0));
}

}  // namespace
}  // namespace fathom
