// A clear cup from a glTF file with water in it against its analytic twin, and against itself.
#include <gtest/gtest.h>

#include "core/rng.h"
#include "tests/core/temporary_folder.h"
#include "tests/render/gltf_tumbler.h"
#include "tests/render/scenes.h"
#include "tests/scene/vessels.h"
#include "tests/soak/light_laws.h"

namespace fathom {
namespace {

/// Of glass, wider at the top: rays straight up pass through its wall, and through what of the liquid reaches into it.
constexpr const char* kFlaredGlass = R"({"inner_profile_mm": [[0, 7], [30, 7], [40, 87]],
    "outer_profile_mm": [[0, 0], [33, 0], [33, 7], [43, 87]], "material": {"index": 1.51, "absorption_per_mm": 0.044}})";
/// By how much the facets of its mesh stand off its outer wall [m], and by how much they lean against it.
constexpr double kLean = std::numbers::pi / kFacetsAround;
const double kSagitta = 0.043 * (1.0 - std::cos(kLean));

CupShape flared_shape() { return std::get<CupShape>(cup_of(kFlaredGlass, "").scene.cups[0].shape); }

class GltfTumbler : public testing::TestWithParam<Shading> {
 protected:
  /// The flared cup with `more` in it, from a file.
  fathom::Setup mesh_cup(const std::string& more) const {
    const auto file = write_tumbler(folder_ / "", flared_shape(), 1.51, 0.044, GetParam());
    return gltf_cup_of(file, more);
  }

 private:
  TemporaryFolder folder_;
};

std::optional<SeenPoint> seen_at(const LitScene& scene, int x, int y) {
  return see(scene.world, {scene.rig.camera_in_world(), scene.rig.direction_in_world(x + 0.5, y + 0.5)});
}

TEST_P(GltfTumbler, ShowsThePointsOfItsAnalyticTwin) {
  for (const char* filling : {kWater, ""}) {
    const LitScene twin(cup_of(kFlaredGlass, filling)), scene(mesh_cup(filling));
    std::vector<double> off;
    int refracted = 0;
    for (int y = 0; y < twin.rig.sensor.height; ++y)
      for (int x = 0; x < twin.rig.sensor.width; ++x) {
        const auto expected = seen_at(twin, x, y);
        if (!expected || !expected->refracted) continue;
        ++refracted;
        const auto found = seen_at(scene, x, y);
        const bool same_way = found && found->object == expected->object && found->inside == expected->inside;
        if (same_way) off.push_back((found->point - expected->point).norm());
      }
    ASSERT_GT(refracted, 5000);
    // Along the outlines, about as long as the cup is wide, a facet decides which way a ray goes.
    EXPECT_GT(off.size(), 0.98 * refracted);
    std::sort(off.begin(), off.end());
    const double median = off[off.size() / 2], almost_all = off[off.size() * 99 / 100];
    if (GetParam() == Shading::smooth) {
      // At 70°, as steeply as the sensor looks down, a ray meets a facet 2.7 sagittas off the round wall, four walls on
      // its way. The round walls also turn a ray that they shift, on ways of up to three radii.
      EXPECT_LT(median, 4 * 2.7 * kSagitta);
      EXPECT_LT(almost_all, (1 + 3) * 4 * 2.7 * kSagitta);
    } else {
      // At 70° glass turns a ray by 0.7 of what its surface leans, over ways of up to 0.1 m; four walls are on it.
      EXPECT_LT(median, 0.7 * kLean * 0.1);
      EXPECT_LT(almost_all, 4 * 0.7 * kLean * 0.1);
    }
  }
}

TEST_P(GltfTumbler, HasTheBodiesOfItsAnalyticTwinEverywhere) {
  const LitScene twin(cup_of(kFlaredGlass, kWater)), scene(mesh_cup(kWater));
  const CupShape shape = flared_shape();
  Rng rng(1);
  int in_liquid = 0, in_wall = 0, in_air = 0;
  for (int i = 0; i < 50000; ++i) {
    const Eigen::Vector3d point(0.1 * (rng.uniform() - 0.5), 0.3 + 0.1 * (rng.uniform() - 0.5), 0.1 * rng.uniform());
    const double radius = (point - Eigen::Vector3d(0.0, 0.3, 0.0)).head<2>().norm();
    // Between facet and cone they differ; and where wall and liquid's surface are met at once, straight above.
    const auto is_near = [&](double wall) { return std::fabs(radius - wall) < 2.0 * kSagitta; };
    if (is_near(shape.outer_radius(point.z())) || is_near(shape.inner_radius(point.z())) ||
        is_near(shape.inner_radius(kPaperCupBottom + 0.030)))
      continue;
    const Body* expected = medium_in(twin.geometry, twin.world.bodies_around(point));
    const Body* found = medium_in(scene.geometry, scene.world.bodies_around(point));
    ASSERT_EQ(index_of(found), index_of(expected)) << point.transpose();
    ++(!expected ? in_air : expected == &twin.geometry.bodies.front() ? in_liquid : in_wall);
  }
  EXPECT_GT(in_liquid, 2000);
  EXPECT_GT(in_wall, 2000);
  EXPECT_GT(in_air, 2000);
}

TEST_P(GltfTumbler, PassesLightBackAsItCame) {
  const LitScene scene(mesh_cup(kWater));
  const Body* liquid = &scene.geometry.bodies.front();
  Rng rng(3);
  int pairs = 0;
  for (int i = 0; i < 60; ++i) {
    const Eigen::Vector2d xy = 0.028 * std::sqrt(rng.uniform()) * direction_of(2.0 * std::numbers::pi * rng.uniform());
    const Eigen::Vector3d point(xy.x(), 0.300 + xy.y(), 0.009);
    const Source back{point, scene.world.bodies_around(point)};
    ASSERT_EQ(medium_in(scene.geometry, back.inside), liquid);
    for (const Connection& way : scene.connections(point, liquid)) {
      const auto returned = shoot(scene.world, back, scene.projector.position(), nullptr, -way.arrival, way.crossings);
      ASSERT_TRUE(returned);
      // A hit is within 1e-10 m; over the shortest piece, 30 mm, and with what a curved surface adds.
      EXPECT_LT((returned->direction + way.arrival).norm(), 1e-7);
      EXPECT_NEAR(returned->spreading * 1.3281 * 1.3281 / way.spreading, 1.0, 1e-6);
      EXPECT_NEAR(returned->transmittance / way.transmittance, 1.0, 1e-9);
      ++pairs;
    }
  }
  EXPECT_GT(pairs, 20);
}

INSTANTIATE_TEST_SUITE_P(Shaded, GltfTumbler, testing::Values(Shading::flat, Shading::smooth),
                         [](const auto& shading) { return shading.param == Shading::flat ? "Flat" : "Smooth"; });

// Twelve sides: with very many, tubes a microradian wide pass over edges that bend them too little to be told.
TEST(FlatGltfTumbler, MakesNoLightAndCountsNoneTwice) {
  const TemporaryFolder folder;
  const Mesh mesh =
      sheet_of_revolution({{0.0, 0.0}, {0.033, 0.0}, {0.043, 0.087}, {0.040, 0.087}, {0.030, 0.007}, {0.0, 0.007}}, 12);
  const auto file = write_clear_gltf(folder / "", mesh, 1.51, 0.044);
  fathom::Setup setup = gltf_cup_of(file, kWater);
  SensorModel& sensor = setup.rig.sensor;
  sensor.width = 60, sensor.height = 60, sensor.principal_px = {30.0, 30.0}, sensor.focal_px = 250.0;
  const LitScene scene(setup);
  TubeCounts counts;
  EXPECT_EQ(broken_light_laws(scene.projector, scene.rig, counts), std::vector<std::string>{});
  EXPECT_GT(counts.held, 4000u);
  EXPECT_LT(counts.torn, counts.held / 100);
}

}  // namespace
}  // namespace fathom
