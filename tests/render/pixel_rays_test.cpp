// The bent rays of pixels, as pictures show them, are those by which the pixels are measured.
#include "sim/render/pixel_rays.h"

#include <gtest/gtest.h>

#include "sim/render/truth.h"
#include "tests/render/scenes.h"

namespace fathom {
namespace {

/// By how much the sines of a ray's angles to the vertical miss Snell's law at a level surface.
double snell_error(const Eigen::Vector3d& from, const Eigen::Vector3d& bend, const Eigen::Vector3d& to, double index) {
  const Eigen::Vector3d above = (bend - from).normalized(), below = (to - bend).normalized();
  return (above.head<2>() - index * below.head<2>()).norm();
}

/// Calls `visit` with every fourth pixel and its rays.
template <class Visit>
void for_some_pixels(const LitScene& scene, Visit visit) {
  for (int y = 0; y < scene.rig.sensor.height; y += 4)
    for (int x = 0; x < scene.rig.sensor.width; x += 4)
      if (const auto rays = rays_of_pixel(scene.projector, scene.rig, x + 0.5, y + 0.5)) visit(x, y, *rays);
}

TEST(PixelRays, BendOnceUnderWaterBySnellsLaw) {
  const auto setup = cup_setup(30.0, 300.0, 300.0);
  const LitScene scene(setup);
  const double index = setup.scene.cups[0].filling->medium.n(scene.rig.sensor.wavelength_nm);
  int through_water = 0;
  for_some_pixels(scene, [&](int, int, const PixelRays& rays) {
    if (!rays.seen.refracted || !rays.light) return;
    ASSERT_EQ(rays.camera_bends.size(), 1U);
    ASSERT_EQ(rays.projector_bends.size(), 1U);
    EXPECT_LT(snell_error(scene.rig.camera_in_world(), rays.camera_bends[0], rays.seen.point, index), 1e-9);
    EXPECT_LT(snell_error(scene.rig.projector_in_world(), rays.projector_bends[0], rays.seen.point, index), 1e-9);
    ++through_water;
  });
  EXPECT_GT(through_water, 30);
}

TEST(PixelRays, CrossWhereTheTruthHasTheApparentDepth) {
  const LitScene scene(cup_setup(30.0, 300.0, 300.0));
  const Image<TruePixel> truth = trace_truth(scene.projector, scene.rig);
  for_some_pixels(scene, [&](int x, int y, const PixelRays& rays) {
    ASSERT_EQ(rays.light.has_value(), truth(x, y).apparent_depth.has_value()) << x << ' ' << y;
    EXPECT_EQ(rays.seen.point, truth(x, y).position);
    if (!rays.light) return;
    const auto first = [&](const std::vector<Eigen::Vector3d>& bends) {
      return bends.empty() ? rays.seen.point : bends.front();
    };
    const auto depth = triangulated_depth(scene.rig, first(rays.camera_bends) - scene.rig.camera_in_world(),
                                          first(rays.projector_bends) - scene.rig.projector_in_world());
    ASSERT_TRUE(depth);
    EXPECT_NEAR(*depth, *truth(x, y).apparent_depth, 1e-9);
  });
}

TEST(PixelRays, InGlassTheProjectorsRayBendsWhereOneThatIsSentBends) {
  const LitScene scene(setup_from_json(Json::parse(R"({
      "sensor": {"model": "xtion_pro_live", "height_mm": 650, "aim_mm": [0, 300, 0]},
      "cups": [{"shape": {"height_mm": 87, "bottom_mm": 7, "inner_radius_mm": 40, "outer_radius_mm": 43,
                          "material": "soda_lime"}, "position_mm": [0, 300], "liquid": "water", "fill_mm": 30}]})"),
                                       "test"));
  int bent = 0;
  for_some_pixels(scene, [&](int, int, const PixelRays& rays) {
    if (rays.projector_bends.size() < 3) return;
    std::vector<Eigen::Vector3d> bends;
    const auto end = see(scene.world, {scene.rig.projector_in_world(), rays.light->direction}, 0, &bends);
    ASSERT_TRUE(end);
    EXPECT_LT((end->point - rays.seen.point).norm(), 1e-7);
    ASSERT_EQ(bends.size(), rays.projector_bends.size());
    for (std::size_t i = 0; i < bends.size(); ++i) EXPECT_LT((bends[i] - rays.projector_bends[i]).norm(), 1e-7);
    ++bent;
  });
  EXPECT_GT(bent, 30);
}

}  // namespace
}  // namespace fathom
