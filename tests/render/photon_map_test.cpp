// Light that no search for connections finds, beside light that is traced without any importance.
#include "sim/render/photon_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/estimate.h"
#include "core/rng.h"
#include "sim/optics/interface.h"
#include "sim/render/fan.h"
#include "tests/render/scenes.h"

namespace fathom {
namespace photon_map_test {

const Eigen::Vector3d kAxis(0.0, 0.300, 0.0);
constexpr double kAround = 0.15;  // [m] about the glass

/// What is on the desk around a glass, and what lies under it.
bool counts(const Eigen::Vector3d& point) { return (point - kAxis).head<2>().norm() < kAround; }

/// Power on the desk [of unit radiant intensity] that two interfaces or more reflected in part, or that more than
/// kLongestChain led there: of packets that leave the projector evenly in a cone, each reflected by Fresnel's chance.
Estimate traced(const LitScene& scene) {
  constexpr double kCone = 0.1;  // [rad] the glass fills 0.15 in width
  const Eigen::Vector3d source = scene.projector.position();
  const Eigen::Vector3d axis = (kAxis + Eigen::Vector3d(0.0, 0.0, 0.05) - source).normalized();
  const Matrix32d basis = perpendicular_to(axis);
  const auto arriving = [&](Walker walker, Rng& rng) {
    int crossings = 0, reflections = 0;
    while (crossings < kMostCrossings) {
      const auto hit = scene.world.first_hit({walker.position, walker.direction});
      if (!hit) return 0.0;
      const Body* medium = medium_in(scene.geometry, walker.region);
      if (medium) walker.weight *= std::exp(-medium->medium.absorption * hit->distance);
      walker.position = hit->point;
      if (std::holds_alternative<Diffuse>(hit->surface->optics))
        return counts(hit->point) && (reflections >= 2 || crossings > kLongestChain) ? walker.weight : 0.0;
      const BodySet after = beyond(*hit, walker.region);
      const double from = index_of(medium), to = index_of(medium_in(scene.geometry, after));
      crossings += from != to;
      const bool in_part = refract(walker.direction, hit->normal, from, to).has_value();
      if (cross_interface(walker, hit->normal, from, to, rng))
        walker.region = after;
      else
        reflections += in_part;
    }
    return 0.0;
  };
  Rng rng(3);
  Mean power;
  for (int i = 0; i < 600'000; ++i) {
    const double cosine = 1.0 - rng.uniform() * (1.0 - std::cos(kCone));
    const Eigen::Vector2d aside =
        std::sqrt(1.0 - cosine * cosine) * direction_of(2.0 * std::numbers::pi * rng.uniform());
    power.add(arriving({source, cosine * axis + basis * aside}, rng));
  }
  const double solid_angle = 2.0 * std::numbers::pi * (1.0 - std::cos(kCone));
  return {solid_angle * power.estimate().value, solid_angle * power.estimate().standard_error};
}

TEST(PhotonMap, HoldsAllThatAGlassReflectsTwiceOrMore) {
  const LitScene scene(cup_of(kGlassCup, kWater));
  const PhotonMap map(scene.world, {scene.projector.position(), 0});
  double power = 0.0, squares = 0.0;
  for (const Photon& photon : map.photons())
    if (counts(photon.point.cast<double>())) power += photon.power, squares += photon.power * photon.power;
  const Estimate expected = traced(scene);
  EXPECT_LT(expected.standard_error, 0.03 * expected.value);
  EXPECT_LT(std::sqrt(squares), 0.02 * power);
  // Wrong once in 16,000 seeds; these are fixed.
  EXPECT_NEAR(power, expected.value, 4.0 * std::hypot(expected.standard_error, std::sqrt(squares)));

  // Their irradiance, summed over the desk, is the same power: but for what lies at the rim of the area.
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  Mean irradiance;
  Rng rng(4);
  for (int i = 0; i < 200'000; ++i) {
    const double radius = (kAround + PhotonMap::kRadius) * std::sqrt(rng.uniform());
    const Eigen::Vector2d aside = radius * direction_of(2.0 * std::numbers::pi * rng.uniform());
    const Eigen::Vector3d point = kAxis + Eigen::Vector3d(aside.x(), aside.y(), 0.0);
    double sum = 0.0;
    map.near(point, up, [&](const Photon& photon, double more) {
      if (counts(photon.point.cast<double>())) sum += more;
    });
    irradiance.add(sum);
  }
  const double area = std::numbers::pi * std::pow(kAround + PhotonMap::kRadius, 2);
  EXPECT_NEAR(area * irradiance.estimate().value, power, 4.0 * area * irradiance.estimate().standard_error);
}

TEST(PhotonMap, IsDarkBehindASurface) {
  const LitScene scene(cup_of(kGlassCup, kWater));
  const PhotonMap map(scene.world, {scene.projector.position(), 0});
  int seen = 0;
  for (const Photon& photon : map.photons()) {
    map.near(photon.point.cast<double>(), -photon.normal.cast<double>(), [&](const Photon&, double) { ++seen; });
  }
  EXPECT_EQ(seen, 0);
}

}  // namespace photon_map_test
}  // namespace fathom
