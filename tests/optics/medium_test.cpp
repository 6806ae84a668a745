// Media: index by wavelength, absorption, and scattering seen from outside.
#include "sim/optics/medium.h"

#include <gtest/gtest.h>

#include "sim/scene/scene.h"
#include "tests/core/expect_error.h"

namespace fathom {
namespace {

Medium library_medium(const std::string& name) {
  const Json json = name;
  return medium_from_json(JsonReader(json, "test"));
}

TEST(Medium, WaterBendsInfraredLessThanYellow) {
  const Medium water = library_medium("water");
  EXPECT_NEAR(water.n(830.0), 1.32810, 5e-6);  // half a unit of the printed digit
  EXPECT_NEAR(water.n(589.3), 1.3333, 5e-4);   // the paper's 1.333, half a unit of its last digit
}

TEST(Medium, IsNotAskedOutsideItsRange) {
  const Medium water = library_medium("water");
  expect_error([&] { water.n(1130.0); }, {"water: ", "1130 nm", "182 to 1129 nm"});
  expect_error([&] { water.n(181.0); }, {"water: "});
}

TEST(Medium, AConstantIndexIsConstant) {
  const Medium milk_tea = library_medium("milk_tea");
  EXPECT_EQ(milk_tea.n(830.0), 1.336);
  EXPECT_EQ(milk_tea.n(500.0), 1.336);
}

TEST(Medium, TransmittanceMultipliesAlongAPath) {
  // Beer–Lambert: two stretches are one. Roundings only.
  EXPECT_NEAR(transmittance(3.1, 0.03) * transmittance(3.1, 0.05), transmittance(3.1, 0.08), 1e-15);
  EXPECT_EQ(transmittance(3.1, 0.0), 1.0);
  EXPECT_EQ(transmittance(0.0, 5.0), 1.0);
  EXPECT_NEAR(transmittance(2.0, 0.5), 0.36787944117144233, 1e-16);  // 1/e
}

TEST(Medium, DiffuseReflectanceGrowsWithScatteringAndShrinksWithAbsorption) {
  Medium liquid = library_medium("milk_tea");
  const double n = liquid.n(830.0), as_it_is = diffuse_reflectance(liquid, n);
  EXPECT_GT(as_it_is, 0.0);
  EXPECT_LT(as_it_is, 1.0);
  liquid.scattering *= 2.0;
  EXPECT_GT(diffuse_reflectance(liquid, n), as_it_is);
  liquid.scattering *= 0.5, liquid.absorption *= 2.0;
  EXPECT_LT(diffuse_reflectance(liquid, n), as_it_is);
}

TEST(Medium, AWhiteLiquidGivesBackAllThatEnters) {
  Medium liquid;
  liquid.scattering = 1000.0;
  // Without absorption only the surface's outer reflection, 0.0659 of diffuse light at n = 1.33, is not part of it.
  // 1e-5: the midpoint rule over the square root at the critical angle.
  EXPECT_NEAR(diffuse_reflectance(liquid, 1.33), 1.0 - 0.06593, 1e-5);
}

}  // namespace
}  // namespace fathom
