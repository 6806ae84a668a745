// How bright things are: against counted photons, and against Beer and Lambert.
#include <gtest/gtest.h>

#include "core/rng.h"
#include "sim/optics/fresnel.h"
#include "sim/optics/snell.h"
#include "sim/render/connection.h"
#include "sim/render/radiance.h"
#include "tests/render/scenes.h"

namespace fathom {
namespace irradiance_test {

constexpr double kFill = 0.030, kLevel = kPaperCupBottom + kFill;

/// The paper's cup at 300 mm with 30 mm of a liquid of index 1.3281.
LitScene filled_view(double absorption_per_mm) {
  Setup setup = cup_setup(30.0, 300.0, 300.0);
  Medium& medium = setup.scene.cups[0].filling->medium;
  medium.index = ConstantIndex{1.3281};
  medium.absorption = per_metre_from_per_mm(absorption_per_mm);
  return LitScene(setup);
}

TEST(Irradiance, ThroughTheSurfaceIsWhatCountedPhotonsBring) {
  const LitScene view = filled_view(0.0);
  const Eigen::Vector3d projector = view.rig.projector_in_world();
  const auto seen = see(view.world, view.camera_ray({0.0, 0.300, kLevel}));
  ASSERT_TRUE(seen && seen->around);
  ASSERT_NEAR(seen->point.z(), kPaperCupBottom, 1e-12);
  const auto light = illuminate(view.projector, *seen);
  ASSERT_TRUE(light);

  // Photons of unit radiant intensity leave the projector evenly over a cone around the connection, refract, and are
  // counted in a disc around the point, weighted by their transmittance.
  constexpr int kPhotons = 1'000'000;
  constexpr double kDisc = 0.002, kCone = 0.006;  // [m], half opening
  const double solid_angle = 2.0 * std::numbers::pi * (1.0 - std::cos(kCone));
  const Eigen::Vector3d right = light->direction.cross(Eigen::Vector3d::UnitZ()).normalized();
  const Eigen::Vector3d up = right.cross(light->direction);
  Rng rng(20);
  double weight = 0.0;
  int landed = 0;
  for (int i = 0; i < kPhotons; ++i) {
    const double cosine = 1.0 - rng.uniform() * (1.0 - std::cos(kCone)), phi = 2.0 * std::numbers::pi * rng.uniform();
    const double sine = std::sqrt(1.0 - cosine * cosine);
    const Eigen::Vector3d direction = cosine * light->direction + sine * (std::cos(phi) * right + std::sin(phi) * up);
    const Eigen::Vector3d bend = projector + direction * ((kLevel - projector.z()) / direction.z());
    const Eigen::Vector3d inside = *refract(direction, Eigen::Vector3d::UnitZ(), 1.0, 1.3281);
    const Eigen::Vector3d end = bend + inside * ((kPaperCupBottom - kLevel) / inside.z());
    if ((end - seen->point).norm() > kDisc) continue;
    weight += 1.0 - fresnel_reflectance(-direction.z(), 1.0, 1.3281);
    ++landed;
  }
  const double counted = weight / kPhotons * solid_angle / (std::numbers::pi * kDisc * kDisc);
  const double share = static_cast<double>(landed) / kPhotons;
  const double relative_error = std::sqrt((1.0 - share) / landed);  // of the binomial count
  EXPECT_LT(relative_error, 0.004);
  // 4 standard errors: wrong once in 16000 seeds; this one is fixed. The disc is small enough (2 mm of 650) to change
  // the mean by less than 1e-5.
  EXPECT_NEAR(light->irradiance / counted, 1.0, 4.0 * relative_error);
}

TEST(Irradiance, ABareSurfaceFollowsTheInverseSquareAndTheCosine) {
  const LitScene view(desk_setup());
  const Eigen::Vector3d point(0.05, 0.40, 0.0), projector = view.rig.projector_in_world();
  const auto seen = see(view.world, view.camera_ray(point));
  ASSERT_TRUE(seen);
  EXPECT_LT((seen->point - point).norm(), 1e-12);
  const auto light = illuminate(view.projector, *seen);
  ASSERT_TRUE(light);
  const double distance = (point - projector).norm(), cosine = projector.z() / distance;
  EXPECT_NEAR(light->irradiance * distance * distance / cosine, 1.0, 1e-12);
  // In the camera's numbers: 5.90e8 · albedo · cos / r², r in mm.
  EXPECT_NEAR(radiance_dn(view.rig.sensor, *seen, *light), 5.90e8 * 0.55 * cosine / (distance * distance * 1e6), 1e-9);
}

TEST(Radiance, UnderAnAbsorbingLiquidFollowsBeerAndLambert) {
  const LitScene clear = filled_view(0.0), murky = filled_view(0.02);
  for (const double y : {0.285, 0.300, 0.315}) {
    const Ray ray = clear.camera_ray({0.005, y, kLevel});
    const auto seen = see(clear.world, ray), seen_murky = see(murky.world, ray);
    ASSERT_TRUE(seen && seen->around && seen_murky);
    const auto light = illuminate(clear.projector, *seen);
    const auto light_murky = illuminate(murky.projector, *seen_murky);
    ASSERT_TRUE(light && light_murky);
    // Both ways inside have the liquid's depth over the cosine of the refracted angle, which Snell's law gives from the
    // directions in air.
    const auto path = [](const Eigen::Vector3d& direction) {
      const double sine = direction.head<2>().norm() / 1.3281;
      return kFill / std::sqrt(1.0 - sine * sine);
    };
    const double expected = std::exp(-20.0 * (path(ray.direction) + path(light->direction)));
    const double ratio =
        radiance_dn(murky.rig.sensor, *seen_murky, *light_murky) / radiance_dn(clear.rig.sensor, *seen, *light);
    EXPECT_NEAR(ratio / expected, 1.0, 1e-12);  // roundings
  }
}

TEST(Radiance, ThroughTheSurfaceLosesTheFresnelPartAndSpreadsByTheIndexSquared) {
  const LitScene view = filled_view(0.0);
  const Ray ray = view.camera_ray({0.0, 0.300, kLevel});
  const auto seen = see(view.world, ray);
  ASSERT_TRUE(seen && seen->around);
  const double through = 1.0 - fresnel_reflectance(-ray.direction.z(), 1.0, 1.3281);
  EXPECT_NEAR(seen->transmittance, through / (1.3281 * 1.3281), 1e-15);
}

}  // namespace irradiance_test
}  // namespace fathom
