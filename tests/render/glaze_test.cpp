// Glazed surfaces in scenes: as bright as their BRDF says, the same from either end, and never taking light of their
// own.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/render/light_walk.h"
#include "sim/render/radiance.h"
#include "sim/render/world_space.h"
#include "tests/render/scenes.h"

namespace fathom {
namespace {

Setup glazed_desk(double roughness) {
  return setup_from_json(Json::parse(fmt::format(R"({{"sensor": {{"height_mm": 650, "pitch_deg": 90}},
      "desk": {{"albedo": 0.6, "centre_mm": [0, 0], "glaze": {{"roughness": {}, "index": 1.5}}}}}})",
                                                 roughness)),
                         "test");
}

/// Irradiance · BRDF on a level desk [1/(m² sr)], from the formulas of ggx.h and glaze.h.
double radiance_of_desk(const Glaze& glaze, double roughness, const Eigen::Vector3d& point,
                        const Eigen::Vector3d& light, const Eigen::Vector3d& eye) {
  const Eigen::Vector3d from = (light - point).normalized(), to = (eye - point).normalized();
  const double brdf = glaze.diffuse(from, to) + ggx_reflection(from, to, roughness, 1.0, 1.5);
  return brdf * from.z() / (light - point).squaredNorm();
}

TEST(GlazedDesk, IsAsBrightAsItsBrdfAndBrightestInTheMirror) {
  for (const double roughness : {kLeastRoughness, 0.1, 0.4}) {
    const LitScene scene(glazed_desk(roughness));
    const Glaze glaze(0.6, roughness, 1.0, 1.5);
    const Eigen::Vector3d camera = scene.rig.camera_in_world(), projector = scene.rig.projector_in_world();
    double brightest = 0.0, brightest_x = 0.0;
    for (double x = -0.2; x < 0.201; x += 0.002) {
      const Eigen::Vector3d point(x, 0.01, 0.0);
      const auto seen = see(scene.world, scene.camera_ray(point));
      ASSERT_TRUE(seen && seen->glaze);
      const auto light = illuminate(scene.projector, *seen);
      ASSERT_TRUE(light);
      const double dn = radiance_dn(scene.rig.sensor, *seen, *light);
      const double expected = radiance_of_desk(glaze, roughness, point, projector, camera);
      // Roundings of the half vector, sharpened by 1/α².
      EXPECT_NEAR(dn / radiance_dn(scene.rig.sensor, std::numbers::pi * expected), 1.0, 1e-11);
      if (dn > brightest) brightest = dn, brightest_x = x;
    }
    // Camera and projector are as high, so the mirror image stands between them; a step is 2 mm. Rougher highlights
    // lean towards the projector's foot, where more light falls.
    if (roughness == kLeastRoughness) {
      EXPECT_NEAR(brightest_x, 0.0, 1.1e-3);
    }
  }
}

TEST(GlazedCup, LooksTheSameWithCameraAndProjectorExchanged) {
  // Dry walls and, since light gets wider and narrower by n² on its way in and out, walls under water.
  const auto setup = cup_of(kPaperCup, std::string(R"(, "glaze": {"roughness": 0.1})") + kWater);
  const LitScene scene(setup);
  const PointLight at_camera(scene.world, scene.rig.camera_in_world());
  int dry = 0, wet = 0;
  for (double x = -0.03; x < 0.031; x += 0.003)
    for (double y = 0.27; y < 0.346; y += 0.003) {
      const auto seen = see(scene.world, scene.camera_ray({x, y, 0.037}));
      if (!seen || !seen->glaze) continue;
      const auto light = illuminate(scene.projector, *seen);
      if (!light) continue;
      const auto back = see(scene.world, {scene.rig.projector_in_world(), light->direction});
      ASSERT_TRUE(back && back->glaze);
      const auto light_back = illuminate(at_camera, *back);
      ASSERT_TRUE(light_back);
      // The point is met to 1e-10 m and its normal turns by 1 rad over 40 mm; the lobe sharpens that by 1/α.
      EXPECT_NEAR(light->reflectance / light_back->reflectance, 1.0, 1e-6);
      ++(seen->around ? wet : dry);
    }
  EXPECT_GT(dry, 50);
  EXPECT_GT(wet, 50);
}

/// Sums what arrives at black walls.
struct Furnace {
  double arrived = 0.0;
  void at_scattering(const Walker&) {}
  void at_wall(const Walker& walker, const Eigen::Vector3d&, double albedo) {
    if (albedo == 0.0) arrived += walker.weight;
  }
  void at_glazed_wall(const Walker&, const Eigen::Vector3d&, const Glaze&) {}
};

TEST(GlazedCup, OfAWhiteBodySendsAllLightOutAgain) {
  // Walks into a cup that absorbs nothing, from within its mouth, end in the room around it.
  for (const double roughness : {0.02, 0.3})
    for (const char* liquid : {"", R"(, "liquid": {"index": 1.3281}, "fill_mm": 30)"}) {
      auto setup = cup_of(R"({"height_mm": 87, "bottom_mm": 7, "inner_radius_mm": 40, "outer_radius_mm": 43,
                               "albedo": 1, "handle": {}})",
                          fmt::format(R"(, "glaze": {{"roughness": {}}}{})", roughness, liquid));
      setup.scene.desk.reset();
      Geometry geometry = build_geometry(setup.scene, 830.0);
      add_room(geometry);
      const Intersector world(geometry);
      const WorldSpace space(world);
      constexpr int kWalks = 20000;
      Rng rng(5);
      double sum = 0.0, squares = 0.0;
      for (int i = 0; i < kWalks; ++i) {
        const Eigen::Vector2d aside = 0.035 * sample_disc(rng);
        Furnace furnace;
        random_walk(space, {{aside.x(), 0.300 + aside.y(), 0.080}, -sample_diffuse(Eigen::Vector3d::UnitZ(), rng)},
                    kRouletteShare, rng, furnace);
        sum += furnace.arrived, squares += furnace.arrived * furnace.arrived;
      }
      const double mean = sum / kWalks, error = std::sqrt((squares / kWalks - mean * mean) / kWalks);
      EXPECT_NEAR(mean, 1.0, 4.0 * error) << roughness << liquid;  // 4 SE: once in 16 000 with a fresh seed
      EXPECT_LT(error, 0.005);
    }
}

TEST(GlazedCup, ThrowsOnWhatADiffuseOneDoesWhenTheCoatIsNone) {
  // A coat of air's index is no coat; then walks of both kinds have the same mean.
  double means[2], errors[2];
  for (const int glazed : {0, 1}) {
    const LitScene scene(cup_of(kPaperCup, glazed ? R"(, "glaze": {"roughness": 0.5, "index": 1.0})" : ""));
    const auto seen = see(scene.world, scene.camera_ray({0.0, 0.300, kPaperCupBottom}));
    ASSERT_TRUE(seen);
    EXPECT_EQ(seen->glaze != nullptr, glazed == 1);
    EXPECT_NEAR(seen->albedo, 0.7, 1e-12);
    constexpr int kWalks = 20000;
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < kWalks; ++i) {
      Rng rng(6, i, glazed);
      double one = 0.0;
      walk_light(scene.projector, *seen, rng, [&](const ReturnedLight& light) { one += light.reflected; });
      sum += one, squares += one * one;
    }
    means[glazed] = sum / kWalks;
    errors[glazed] = std::sqrt((squares / kWalks - means[glazed] * means[glazed]) / kWalks);
    EXPECT_LT(errors[glazed], 0.02 * means[glazed]);
  }
  // 4 SE of the difference: once in 16 000 with a fresh seed.
  EXPECT_NEAR(means[0], means[1], 4.0 * std::hypot(errors[0], errors[1]));
}

}  // namespace
}  // namespace fathom
