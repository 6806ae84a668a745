#include "theory/raised_bottom.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace fathom::theory {
namespace raised_bottom_test {

constexpr double kDeg = std::numbers::pi / 180.0;
constexpr double kWater = 1.333;
// A formula of a few operations near 1 mm … 1 m is good to some 10 roundings of 1 m.
constexpr double kRounding = 1e-14;

const BottomView kPaper{.h = 0.650, .b = 0.075, .d = 0.400, .n = kWater};

TEST(RaisedBottom, RisesWithIncidence) {
  double before = raised_height(0.03, 0.0, kWater);
  for (int deg = 1; deg <= 90; ++deg) {
    const double height = raised_height(0.03, deg * kDeg, kWater);
    EXPECT_GT(height, before) << deg << " deg";
    before = height;
  }
}

TEST(RaisedBottom, RisesWithTheIndex) {
  double before = 0.0;
  for (double n = 1.01; n < 2.0; n += 0.01) {
    const double height = raised_height_at(0.03, {.h = 0.65, .b = 0.075, .d = 0.4, .n = n});
    EXPECT_GT(height, before) << "n = " << n;
    before = height;
  }
}

TEST(RaisedBottom, IsProportionalToTheDepth) {
  const double per_metre = raised_height_at(1.0, kPaper);
  for (const double w : {0.0, 1e-6, 0.01, 0.03, 0.3})
    EXPECT_NEAR(raised_height_at(w, kPaper), w * per_metre, kRounding);
}

TEST(RaisedBottom, LooksStraightDownToTheFractionOneOverN) {
  EXPECT_NEAR(apparent_depth(0.03, 0.0, kWater), 0.03 / kWater, kRounding);
  // The limit is reached smoothly: the next term of the series is of order θ1², here 1e-12.
  EXPECT_NEAR(apparent_depth(0.03, 1e-6, kWater), 0.03 / kWater, 1e-13);
}

TEST(RaisedBottom, ReachesTheSurfaceAtGrazingIncidence) {
  EXPECT_NEAR(raised_height(0.03, std::numbers::pi / 2.0, kWater), 0.03, kRounding);
}

TEST(RaisedBottom, StaysWithoutRefraction) {
  for (const double deg : {0.0, 30.0, 60.0, 89.0}) EXPECT_NEAR(raised_height(0.03, deg * kDeg, 1.0), 0.0, kRounding);
}

TEST(RaisedBottom, ApparentDepthIsEquation1AsPrinted) {
  for (const double deg : {1.0, 30.0, 60.0, 85.0}) {
    const double theta_1 = deg * kDeg;
    const double theta_2 = refraction_angle(theta_1, kWater);
    EXPECT_NEAR(std::sin(theta_1), kWater * std::sin(theta_2), kRounding);
    EXPECT_NEAR(apparent_depth(0.03, theta_1, kWater), 0.03 * std::tan(theta_2) / std::tan(theta_1), kRounding);
  }
}

TEST(RaisedBottom, Equation7IsEquation3OfEquation6AndAsPrinted) {
  for (const double d : {0.2, 0.3, 0.4, 0.5, 0.6}) {
    const BottomView view{.h = 0.65, .b = 0.075, .d = d, .n = kWater};
    const double p = std::sqrt(d * d + 0.0375 * 0.0375);
    EXPECT_NEAR(horizontal_distance(d, 0.075), p, kRounding);
    EXPECT_NEAR(incidence_angle_at(d, 0.075, 0.65), incidence_angle(p, 0.65), kRounding);
    const double printed = 0.03 - 0.65 * 0.03 * std::tan(std::asin(std::sin(std::atan(p / 0.65)) / kWater)) / p;
    EXPECT_NEAR(raised_height_at(0.03, view), printed, kRounding);
    EXPECT_NEAR(raised_height_at(0.03, view), raised_height(0.03, incidence_angle_at(d, 0.075, 0.65), kWater),
                kRounding);
  }
}

TEST(RaisedBottom, KnownHeights) {
  // To the printed digits.
  EXPECT_NEAR(raised_height_at(0.030, {.h = 0.65, .b = 0.075, .d = 0.4, .n = kWater}) * 1e3, 9.167, 0.0005);
  EXPECT_NEAR(raised_height_at(0.030, {.h = 0.65, .b = 0.075, .d = 0.6, .n = kWater}) * 1e3, 10.800, 0.0005);
}

TEST(RaisedBottom, KnownApparentDepthsOfWaterInTheInfrared) {
  const std::vector<std::pair<double, double>> printed{
      {0.0, 0.75296}, {30.0, 0.70386}, {45.0, 0.62898}, {60.0, 0.49657}};
  for (const auto& [deg, ratio] : printed) EXPECT_NEAR(apparent_depth(1.0, deg * kDeg, 1.3281), ratio, 0.5e-5);
}

TEST(RaisedBottom, FillReturnsFromItsHeight) {
  for (const double w : {0.0, 1e-4, 0.01, 0.03, 0.08}) {
    // The slope m / w is about 0.3, so the way back triples the rounding.
    EXPECT_NEAR(fill_from_height_at(raised_height_at(w, kPaper), kPaper).value(), w, 4 * kRounding);
    EXPECT_NEAR(fill_from_height(raised_height(w, 0.5, kWater), 0.5, kWater).value(), w, 4 * kRounding);
  }
}

TEST(RaisedBottom, NoFillExplainsAnImpossibleHeight) {
  EXPECT_FALSE(fill_from_height_at(-0.001, kPaper));
  EXPECT_FALSE(fill_from_height(0.001, 0.5, 1.0));
  EXPECT_FALSE(fill_from_height(std::nan(""), 0.5, kWater));
}

TEST(SkewAtFieldEdge, IsThePrintedAngle) {
  // 6.95 deg to the printed digits, from the printed field of view and from the device's 640 px at 570.342 px.
  EXPECT_NEAR(skew_at_field_edge(0.075, 58.5 * kDeg, 0.5) / kDeg, 6.95, 0.005);
  EXPECT_NEAR(skew_at_field_edge(0.075, 2.0 * std::atan(320.0 / 570.342), 0.5) / kDeg, 6.95, 0.005);
}

TEST(SkewAtFieldEdge, GrowsWithTheBaselineAndShrinksWithTheRange) {
  EXPECT_EQ(skew_at_field_edge(0.0, 1.0, 0.5), 0.0);
  EXPECT_GT(skew_at_field_edge(0.10, 1.0, 0.5), skew_at_field_edge(0.075, 1.0, 0.5));
  EXPECT_LT(skew_at_field_edge(0.075, 1.0, 0.8), skew_at_field_edge(0.075, 1.0, 0.5));
}

TEST(RaisedBottom, RefusesNonsense) {
  EXPECT_THROW(raised_height(0.03, 0.5, 0.9), std::invalid_argument);
  EXPECT_THROW(raised_height(-0.03, 0.5, kWater), std::invalid_argument);
  EXPECT_THROW(raised_height(0.03, -0.1, kWater), std::invalid_argument);
  EXPECT_THROW(raised_height(0.03, 1.6, kWater), std::invalid_argument);
  EXPECT_THROW(raised_height(std::nan(""), 0.5, kWater), std::invalid_argument);
  EXPECT_THROW(incidence_angle(0.4, 0.0), std::invalid_argument);
  EXPECT_THROW(horizontal_distance(0.4, -0.075), std::invalid_argument);
  EXPECT_THROW(skew_at_field_edge(0.075, 0.0, 0.5), std::invalid_argument);
}

}  // namespace raised_bottom_test
}  // namespace fathom::theory
