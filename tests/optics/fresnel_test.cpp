// Fresnel's equations against tables and against each other.
#include "sim/optics/fresnel.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"

namespace fathom {
namespace fresnel_test {

constexpr double kWater = 1.328;

double reflectance_at(double angle_deg, double n_from, double n_to) {
  return fresnel_reflectance(std::cos(radians_from_deg(angle_deg)), n_from, n_to);
}

TEST(Fresnel, ReflectanceOfWaterIsTheTabulatedOne) {
  // Half a unit of the last printed digit.
  EXPECT_NEAR(reflectance_at(0.0, 1.0, kWater), 0.019851, 5e-7);
  EXPECT_NEAR(reflectance_at(45.0, 1.0, kWater), 0.027271, 5e-7);
  EXPECT_NEAR(reflectance_at(60.0, 1.0, kWater), 0.058748, 5e-7);
  EXPECT_NEAR(reflectance_at(70.0, 1.0, kWater), 0.132108, 5e-7);
}

TEST(Fresnel, OnlyTheSWaveIsReflectedAtBrewstersAngle) {
  const double brewster = std::atan(kWater);
  EXPECT_NEAR(deg_from_radians(brewster), 53.02, 0.005);  // half a unit of the printed digit
  // There refracted and reflected ray are perpendicular, so that r_s = cos²θ − sin²θ.
  const double s = std::cos(2.0 * brewster) * std::cos(2.0 * brewster);
  EXPECT_NEAR(fresnel_reflectance(std::cos(brewster), 1.0, kWater), 0.5 * s, 1e-15);  // a few roundings of 0.04
}

TEST(Fresnel, NothingLeavesTheWaterBeyondTheCriticalAngle) {
  const double critical_deg = deg_from_radians(std::asin(1.0 / kWater));
  EXPECT_NEAR(critical_deg, 48.85, 0.005);  // half a unit of the printed digit
  EXPECT_EQ(reflectance_at(critical_deg + 1e-6, kWater, 1.0), 1.0);
  EXPECT_EQ(reflectance_at(89.9, kWater, 1.0), 1.0);
  EXPECT_LT(reflectance_at(critical_deg - 1e-6, kWater, 1.0), 1.0);
}

TEST(Fresnel, IsTheSameInBothDirections) {
  for (const double angle_deg : {0.0, 20.0, 45.0, 60.0, 85.0}) {
    const double inside_deg = deg_from_radians(std::asin(std::sin(radians_from_deg(angle_deg)) / kWater));
    // The way there and back through arcsine and cosine costs a few roundings.
    EXPECT_NEAR(reflectance_at(angle_deg, 1.0, kWater), reflectance_at(inside_deg, kWater, 1.0), 1e-14) << angle_deg;
  }
}

TEST(Fresnel, NoStepOfIndexReflectsNothingAndGrazingLightAll) {
  for (const double cosine : {1.0, 0.5, 0.01}) EXPECT_NEAR(fresnel_reflectance(cosine, 1.4, 1.4), 0.0, 1e-24);
  EXPECT_EQ(fresnel_reflectance(0.0, 1.0, kWater), 1.0);
}

TEST(Fresnel, DiffuseLightIsReflectedAsWalshFound) {
  // Half a unit of the last printed digit.
  EXPECT_NEAR(hemispherical_reflectance(1.0, 1.33), 0.06593, 5e-6);
  EXPECT_NEAR(hemispherical_reflectance(1.33, 1.0), 0.47195, 5e-6);
}

TEST(Fresnel, HemisphericalReflectanceIsTheIntegralFromBothSides) {
  for (const double n : {1.05, 1.33, 2.0, 3.0}) {
    for (const auto& [from, to] : {std::pair(1.0, n), std::pair(n, 1.0)}) {
      constexpr int kSteps = 200000;
      double sum = 0.0;
      for (int i = 0; i < kSteps; ++i) {
        const double cosine = (i + 0.5) / kSteps;
        sum += fresnel_reflectance(cosine, from, to) * 2.0 * cosine;
      }
      // The plain sum errs by (step)^1.5 at the critical angle's root: 1e-8 · 1; the function promises 1e-6.
      EXPECT_NEAR(hemispherical_reflectance(from, to), sum / kSteps, 1e-6) << from << " to " << to;
    }
  }
}

}  // namespace fresnel_test
}  // namespace fathom
