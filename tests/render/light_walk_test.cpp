// Light that walks through a liquid: what comes back is what closed forms say where there are any.
#include "sim/render/light_walk.h"

#include <gtest/gtest.h>

#include <numbers>

#include "sim/optics/fresnel.h"
#include "sim/optics/phase.h"
#include "sim/optics/snell.h"
#include "sim/render/radiance.h"
#include "tests/render/scenes.h"

namespace fathom {
namespace {

/// The paper's cup with 30 mm of a liquid of index 1.33, seen where its axis meets the surface.
struct CupOfLiquid {
  Setup setup;
  Geometry geometry;
  Intersector world;
  PointLight projector;
  Ray ray;
  SeenPoint seen;

  CupOfLiquid(double absorption_per_m, double scattering_per_m, double anisotropy, double albedo)
      : setup(with(absorption_per_m, scattering_per_m, anisotropy, albedo)),
        geometry(build_geometry(setup.scene, 830.0)),
        world(geometry),
        projector(world, setup.rig.projector_in_world()),
        ray{setup.rig.camera_in_world(),
            (Eigen::Vector3d(0.0, 0.200, kPaperCupBottom + 0.030) - setup.rig.camera_in_world()).normalized()},
        seen(*see(world, ray)) {}

  static Setup with(double absorption_per_m, double scattering_per_m, double anisotropy, double albedo) {
    Setup setup = cup_setup(30.0, 200.0, 200.0);
    Cup& cup = setup.scene.cups.front();
    std::get<CupShape>(cup.shape).albedo = albedo;
    Medium& medium = cup.filling->medium;
    medium = Medium{};
    medium.index = ConstantIndex{1.33};
    medium.absorption = absorption_per_m;
    medium.scattering = scattering_per_m;
    medium.anisotropy = anisotropy;
    return setup;
  }

  struct Estimate {
    double mean, standard_error;
  };
  Estimate walked(int walks) const {
    double sum = 0.0, squares = 0.0;
    for (int walk = 0; walk < walks; ++walk) {
      Rng rng(1, walk);
      double one = 0.0;
      walk_light(projector, seen, rng, [&](const ReturnedLight& light) { one += light.reflected; });
      sum += one, squares += one * one;
    }
    const double mean = sum / walks;
    return {mean, std::sqrt((squares / walks - mean * mean) / walks)};
  }
};

TEST(LightWalk, WithNextToNoScatteringIsTheClearLiquid) {
  // Black but for 1 %: what bounces twice is below 1 % of what bounces once.
  const CupOfLiquid clear(3.0, 0.0, 0.0, 0.01), thin(3.0, 1e-6, 0.0, 0.01);
  ASSERT_FALSE(clear.seen.entered);
  ASSERT_TRUE(thin.seen.entered);
  const std::optional<Illumination> light = illuminate(clear.projector, clear.seen);
  ASSERT_TRUE(light);
  const double once = clear.seen.albedo * light->irradiance * clear.seen.transmittance;
  const auto walked = thin.walked(2000);
  EXPECT_GT(walked.mean, 0.999 * once);
  EXPECT_LT(walked.mean, 1.01 * once + 4.0 * walked.standard_error);
}

TEST(LightWalk, BetweenBlackWallsIsSingleScatteringWhereLittleScatters) {
  // μs 0.02 per m over 30 mm: twice scattered light is below 1e-3 of the once scattered.
  constexpr double kScattering = 0.02, kAbsorption = 3.0, kAnisotropy = 0.7;
  const CupOfLiquid cup(kAbsorption, kScattering, kAnisotropy, 0.0);
  const Body& body = *cup.seen.entered;
  const Eigen::Vector3d inside = *refract(cup.ray.direction, cup.seen.normal, 1.0, 1.33);
  const double length = 0.030 / -inside.z();
  constexpr int kSteps = 400;  // midpoint rule on a smooth integrand
  double quadrature = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double path = length * (i + 0.5) / kSteps;
    cup.projector.connect({cup.seen.point + path * inside, &body}, [&](const Connection& way) {
      quadrature += std::exp(-body.extinction() * path) * kScattering * length / kSteps *
                    henyey_greenstein(-way.arrival.dot(inside), kAnisotropy) * way.spreading * way.transmittance;
    });
  }
  const double into_air =
      (1.0 - fresnel_reflectance(-cup.ray.direction.dot(cup.seen.normal), 1.0, 1.33)) / (1.33 * 1.33);
  const double expected = std::numbers::pi * into_air * cup.seen.transmittance * quadrature;
  const auto walked = cup.walked(20000);
  // Four standard errors: fails by chance once in 16000; the seed is fixed.
  EXPECT_NEAR(walked.mean, expected, 4.0 * walked.standard_error + 1e-3 * expected);
  EXPECT_LT(walked.standard_error, 0.02 * expected);
}

TEST(LightWalk, DenserLiquidReturnsMoreLightAndNeverMoreThanArrives) {
  double last = 0.0;
  for (const double scattering_per_m : {10.0, 100.0, 1000.0, 10000.0}) {
    const CupOfLiquid cup(0.0, scattering_per_m, 0.0, 0.0);
    const auto walked = cup.walked(4000);
    EXPECT_GT(walked.mean, last);
    last = walked.mean;
    // A white surface at the level reflects all that arrives.
    const Eigen::Vector3d to_light = cup.projector.position() - cup.seen.point;
    const double arriving = to_light.normalized().z() / to_light.squaredNorm();
    EXPECT_LT(walked.mean, arriving + 4.0 * walked.standard_error);
  }
}

TEST(TurbidBodies, EveryWayEndsWhereARayInItsDirectionDoes) {
  // A thin liquid that half the light would cross, behind a wall from which it cannot enter beyond 42°.
  const LitScene scene(cup_of(
      R"({"height_mm": 60, "bottom_mm": 5, "inner_radius_mm": 35, "outer_radius_mm": 40, "material": {"index": 1.64}})",
      R"(, "liquid": {"index": 1.1, "scattering_per_mm": 0.01}, "fill_mm": 40)"));
  int on_desk = 0, on_liquid = 0;
  for (double x = -0.060; x < 0.061; x += 0.004)
    for (double y = 0.240; y < 0.401; y += 0.004) {
      const auto seen = see(scene.world, scene.camera_ray({x, y, 0.0}));
      if (!seen) continue;
      EXPECT_LT(seen->arriving.dot(seen->normal), 0.0);
      if (seen->entered) {
        Rng rng(1, on_liquid);
        walk_light(scene.projector, *seen, rng, [](const ReturnedLight& light) { EXPECT_GE(light.reflected, 0.0); });
      }
      for_each_illumination(scene.projector, SeenPoints{seen}, [&](std::size_t, const Illumination& light) {
        if (light.through_scattering) return;
        ++(seen->entered ? on_liquid : on_desk);
        const auto end = see(scene.world, {scene.projector.position(), light.direction});
        ASSERT_TRUE(end);
        // Connections land to 1e-10 m across the ray; grazing light stretches that on the surface.
        EXPECT_LT((end->point - seen->point).norm(), 1e-7) << seen->point.transpose();
      });
    }
  EXPECT_GT(on_desk, 300);
  EXPECT_GT(on_liquid, 300);
}

}  // namespace
}  // namespace fathom
