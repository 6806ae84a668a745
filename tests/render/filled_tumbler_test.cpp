// A clear cup from a glTF file with water in it against its analytic twin.
#include <gtest/gtest.h>

#include "core/rng.h"
#include "sim/optics/snell.h"
#include "sim/render/shoot.h"
#include "tests/core/temporary_folder.h"
#include "tests/render/gltf_tumbler.h"
#include "tests/render/scenes.h"
#include "tests/soak/light_laws.h"

namespace fathom {
namespace {

constexpr double kOuterRadius = 0.043;

class FilledTumbler : public testing::TestWithParam<Shading> {
 protected:
  /// The cup of kGlassCup with `more` in it, from a file.
  fathom::Setup mesh_cup(const std::string& more) const {
    const CupShape shape = std::get<CupShape>(cup_of(kGlassCup, "").scene.cups[0].shape);
    const auto file = write_tumbler(folder_ / "", shape, 1.51, 0.044, GetParam());
    return cup_of(Json(file.string()).dump(), more);
  }

 private:
  TemporaryFolder folder_;
};

std::optional<SeenPoint> seen_at(const LitScene& scene, int x, int y) {
  return see(scene.world, {scene.rig.camera_in_world(), scene.rig.direction_in_world(x + 0.5, y + 0.5)});
}

TEST_P(FilledTumbler, ShowsThePointsOfItsAnalyticTwin) {
  const LitScene twin(cup_of(kGlassCup, kWater)), scene(mesh_cup(kWater));
  std::vector<double> off;
  int refracted = 0, same = 0;
  for (int y = 0; y < twin.rig.sensor.height; y += 2)
    for (int x = 0; x < twin.rig.sensor.width; x += 2) {
      const auto expected = seen_at(twin, x, y), found = seen_at(scene, x, y);
      if (!expected || !expected->refracted) continue;
      ++refracted;
      if (!found || found->object != expected->object || found->inside != expected->inside) continue;
      ++same;
      off.push_back((found->point - expected->point).norm());
    }
  std::sort(off.begin(), off.end());
  for (double q : {0.5, 0.9, 0.95, 0.99, 0.999, 1.0})
    fmt::print("{} {}: {}\n", same, q,
               off[std::min(static_cast<std::size_t>(static_cast<double>(off.size()) * q), off.size() - 1)]);
  fmt::print("refracted {} same {}\n", refracted, same);
}

TEST_P(FilledTumbler, HasTheTwinsBodiesEverywhere) {
  const LitScene twin(cup_of(kGlassCup, kWater)), scene(mesh_cup(kWater));
  Rng rng(1);
  int in_liquid = 0, in_wall = 0;
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector3d point(0.1 * (rng.uniform() - 0.5), 0.3 + 0.1 * (rng.uniform() - 0.5), 0.1 * rng.uniform());
    // Facets stand off the round walls by their sagitta, 3.2 µm; nothing is said of so thin a layer.
    const double radius = (point - Eigen::Vector3d(0.0, 0.3, 0.0)).head<2>().norm();
    if (std::fabs(radius - kOuterRadius) < 4e-6 || std::fabs(radius - 0.040) < 4e-6) continue;
    const Body* expected = medium_in(twin.geometry, twin.world.bodies_around(point));
    const Body* found = medium_in(scene.geometry, scene.world.bodies_around(point));
    ASSERT_EQ(expected == nullptr, found == nullptr) << point.transpose();
    if (!expected) continue;
    EXPECT_EQ(expected->medium.n, found->medium.n) << point.transpose();
    ++(expected == &twin.geometry.bodies.front() ? in_liquid : in_wall);
  }
  EXPECT_GT(in_liquid, 2000);
  EXPECT_GT(in_wall, 1000);
}

TEST_P(FilledTumbler, MakesNoLightAndCountsNoneTwice) {
  fathom::Setup setup = mesh_cup(kWater);
  setup.rig.sensor.width = 64, setup.rig.sensor.height = 48;
  setup.rig.sensor.focal_px *= 0.1;
  setup.rig.sensor.principal_px *= 0.1;
  const LitScene scene(setup);
  TubeCounts counts;
  EXPECT_EQ(broken_light_laws(scene.projector, scene.rig, counts), std::vector<std::string>{});
  fmt::print("held {} torn {}\n", counts.held, counts.torn);
}

INSTANTIATE_TEST_SUITE_P(Shaded, FilledTumbler, testing::Values(Shading::flat, Shading::smooth),
                         [](const auto& shading) { return shading.param == Shading::flat ? "Flat" : "Smooth"; });

}  // namespace
}  // namespace fathom
