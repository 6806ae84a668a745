// The profile of a liquid at a wall: table of rises, the differential equation, and where it dies out.
#include "sim/optics/meniscus.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/units.h"

namespace fathom {
namespace meniscus_test {

constexpr double kWater = 2.73e-3;  // capillary length [m]

TEST(Meniscus, RisesInWaterAsTabulated) {
  struct Row {
    double contact_angle_deg, rise_mm;
  };
  // Glass, glaze, PMMA, PET, polypropylene. All three columns are rounded: half a unit of the rise is 0.005 mm, of the
  // capillary length 0.006 mm of 3.37, of 13.6° another 0.002 mm.
  for (const Row& row : {Row{13.6, 3.37}, {30.0, 2.73}, {70.9, 0.91}, {72.5, 0.83}, {102.0, -0.58}})
    EXPECT_NEAR(mm_from_metres(meniscus_rise(radians_from_deg(row.contact_angle_deg), kWater)), row.rise_mm, 0.013)
        << row.contact_angle_deg;
}

TEST(Meniscus, MeetsTheWallAtTheContactAngle) {
  for (const double degrees : {1.0, 13.6, 30.0, 87.0, 102.0, 150.0}) {
    const double angle = radians_from_deg(degrees);
    // The slope's angle and the contact angle add up to a right one.
    EXPECT_NEAR(std::atan(Meniscus(angle, kWater).at(0.0).slope), angle - 0.5 * std::numbers::pi, 1e-12) << degrees;
    // A wall that leans outward by as much as is left over leaves the liquid level.
    EXPECT_NEAR(meniscus_rise(angle, kWater, 0.5 * std::numbers::pi - angle), 0.0, 1e-12);
    EXPECT_NEAR(Meniscus(angle, kWater).at(0.0).height, meniscus_rise(angle, kWater), 1e-12);
  }
}

TEST(Meniscus, HasTheProfileOfTheClosedForm) {
  for (const double degrees : {13.6, 60.0, 102.0}) {
    const Meniscus meniscus(radians_from_deg(degrees), kWater);
    const double h = std::fabs(meniscus.at(0.0).height) / kWater;
    for (const double x : {1e-5, 1e-4, 1e-3, 3e-3, 1e-2}) {
      const double z = std::fabs(meniscus.at(x).height) / kWater;
      const double back = std::acosh(2.0 / z) - std::acosh(2.0 / h) + std::sqrt(4.0 - h * h) - std::sqrt(4.0 - z * z);
      EXPECT_NEAR(back * kWater, x, 1e-14) << degrees;  // roundings
    }
  }
}

TEST(Meniscus, SlopeAndCurvatureAreItsDerivatives) {
  for (const double degrees : {13.6, 60.0, 102.0}) {
    const Meniscus meniscus(radians_from_deg(degrees), kWater);
    for (const double x : {2e-4, 1e-3, 5e-3}) {
      const double step = 1e-7;
      const auto left = meniscus.at(x - step), here = meniscus.at(x), right = meniscus.at(x + step);
      // Second-order differences: step² / 6 times the next derivative but one, at most 1e8 / m² and 1e12 / m³ here.
      EXPECT_NEAR((right.height - left.height) / (2.0 * step), here.slope, 2e-6);
      EXPECT_NEAR((right.slope - left.slope) / (2.0 * step), here.curvature, 2e-3);
    }
  }
}

TEST(Meniscus, IsATenthOfAMillimetreHighEightAndAHalfFromTheGlaze) {
  EXPECT_NEAR(mm_from_metres(Meniscus(radians_from_deg(30.0), kWater).at(8.5e-3).height), 0.1, 0.01);
}

}  // namespace meniscus_test
}  // namespace fathom
