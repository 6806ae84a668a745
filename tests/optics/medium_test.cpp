// Media: index by wavelength, absorption, and scattering seen from outside.
#include "sim/optics/medium.h"

#include <gtest/gtest.h>

#include "core/library.h"
#include "sim/optics/water.h"
#include "sim/scene/medium_json.h"
#include "tests/core/expect_error.h"

namespace fathom {
namespace {

Medium library_medium(const std::string& name) {
  const Json json = name;
  return medium_from_json(JsonReader(json, "test"));
}

Medium changed_medium(const char* text) {
  const Json json = Json::parse(text);
  return medium_from_json(JsonReader(json, "test"));
}

TEST(Medium, WaterBendsInfraredLessThanYellow) {
  const Medium water = library_medium("water");
  EXPECT_NEAR(water.n(830.0), 1.328097, 5e-7);  // IAPWS R9-97; half a unit of the printed digit
  EXPECT_NEAR(water.n(589.3), 1.3333, 5e-4);    // the paper's 1.333, half a unit of its last digit
}

TEST(Medium, WaterIsTheReleasesAndAnotherLaboratorys) {
  EXPECT_NEAR(water_index(589.0, 0.0), 1.334344, 2e-6);  // table of IAPWS R9-97; its density is the release's own
  // Daimon & Masumura, Appl. Opt. 46, 2007: distilled water, 20 degC. The release claims 1.5e-5 in the visible.
  const Medium measured = changed_medium(
      R"({"index": {"sellmeier_a": [0.5684027565, 0.1726177391, 0.02086189578, 0.1130748688], "range_nm": [182, 1129],
                    "sellmeier_b_um2": [5.101829712e-3, 1.821153936e-2, 2.620722293e-2, 10.69792721]}})");
  for (const double wavelength_nm : {405.0, 589.3, 830.0})
    EXPECT_NEAR(water_index(wavelength_nm, 20.0), measured.n(wavelength_nm), 2e-5) << wavelength_nm;
}

TEST(Medium, WarmWaterBendsLessAndAbsorbsMore) {
  const Medium warm = changed_medium(R"({"name": "water", "temperature_c": 21})");
  const Medium cool = changed_medium(R"({"name": "water", "temperature_c": 19})");
  EXPECT_NEAR((warm.n(830.0) - cool.n(830.0)) / 2.0, -8.6e-5, 1e-6);     // published to two digits
  EXPECT_NEAR((warm.absorption - cool.absorption) / 2.0, 0.012, 1e-12);  // 1/(m K); roundings
}

TEST(Medium, DensityOfWaterIsKells) {
  EXPECT_NEAR(water_density(4.0), 999.972, 0.01);  // claimed accuracy; maximum density
  EXPECT_NEAR(water_density(20.0), 998.206, 0.01);
  EXPECT_NEAR(water_density(100.0), 958.36, 0.02);
}

TEST(Medium, DilutionIsLinear) {
  const Medium neat = library_medium("intralipid_20"), water = library_medium("water");
  const Medium thin = changed_medium(R"({"name": "intralipid_20", "dilution": 0.05})");
  // Roundings only.
  EXPECT_NEAR(thin.scattering, 0.05 * neat.scattering, 1e-9);
  EXPECT_NEAR(thin.absorption, 0.05 * neat.absorption + 0.95 * water.absorption, 1e-12);
  EXPECT_NEAR(thin.n(830.0), 0.05 * neat.n(830.0) + 0.95 * water.n(830.0), 1e-14);
  EXPECT_EQ(thin.anisotropy, neat.anisotropy);
}

TEST(Medium, ChangesAreRefusedInWords) {
  expect_error([] { changed_medium(R"({"name": "water", "temperature_c": 101})"); }, {"/temperature_c: must be"});
  expect_error([] { changed_medium(R"({"name": "water", "dilution": 0})"); }, {"/dilution: must be"});
  expect_error([] { changed_medium(R"({"name": "wtaer", "dilution": 1})"); }, {"/name: unknown liquid 'wtaer'"});
  expect_error([] { changed_medium(R"({"name": "water", "fill": 1})"); },
               {"choose from name, of, in, temperature_c, dilution"});
  expect_error([] { changed_medium(R"({"index": {"dispersion": "oil"}})"); }, {"/index", "'oil'", "water"});
  expect_error([] { changed_medium(R"({"index": {"dispersion": "water", "n": 1.34}})"); }, {"n and at_nm"});
  expect_error(
      [] { changed_medium(R"({"index": 1.34, "absorption_per_mm": 1, "ranges": {"absorption_per_mm": [2, 3]}})"); },
      {"/ranges/absorption_per_mm: must hold the value itself, 1"});
}

TEST(Medium, EveryMediumIsKnownInTheInfraredAndInYellow) {
  for (const std::string& name : library_names("media")) {
    const Medium medium = library_medium(name);
    EXPECT_GT(medium.n(589.3), medium.n(830.0)) << name;  // normal dispersion
    EXPECT_LT(medium.n(589.3) - medium.n(830.0), 0.01) << name;
  }
}

TEST(Medium, IsNotAskedOutsideItsRange) {
  const Medium water = library_medium("water");
  expect_error([&] { water.n(1130.0); }, {"water: ", "1130 nm", "200 to 1100 nm"});
  expect_error([&] { water.n(181.0); }, {"water: "});
}

TEST(Medium, AConstantIndexIsConstant) {
  const Medium medium = changed_medium(R"({"index": 1.336})");
  EXPECT_EQ(medium.n(830.0), 1.336);
  EXPECT_EQ(medium.n(500.0), 1.336);
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
