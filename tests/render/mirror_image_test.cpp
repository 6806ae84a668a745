// What stands mirrored in liquids and glass: where it is seen, and how bright.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/optics/fresnel.h"
#include "sim/render/connection.h"
#include "tests/render/scenes.h"

namespace fathom {
namespace mirror_image_test {

constexpr double kLevel = kPaperCupBottom + 0.030;

std::vector<SeenPoint> mirrored_on(const Intersector& world, const Ray& ray, Rng& rng) {
  std::vector<SeenPoint> seen;
  see_mirrored(world, ray, rng, [&](const SeenPoint& image) { seen.push_back(image); });
  return seen;
}

TEST(MirrorImage, IsWhereTheCameraMirroredInTheLevelWouldSeeIt) {
  // Clear water and, since only its surface matters, a milky one.
  for (const char* scattering : {"0", "0.5"}) {
    const LitScene scene(
        cup_of(kPaperCup,
               fmt::format(R"(, "liquid": {{"index": 1.3281, "scattering_per_mm": {}}}, "fill_mm": 30)", scattering)));
    const Eigen::Vector3d camera = scene.rig.camera_in_world();
    const Eigen::Vector3d below(camera.x(), camera.y(), 2.0 * kLevel - camera.z());
    int on_wall = 0;
    Rng rng(1);
    for (double x = -0.030; x < 0.031; x += 0.010)
      for (double y = 0.300; y < 0.338; y += 0.0041) {
        const Eigen::Vector3d on_level(x, y, kLevel);
        if ((on_level.head<2>() - Eigen::Vector2d(0.0, 0.300)).norm() > 0.039) continue;
        const Ray ray = scene.camera_ray(on_level);
        const std::vector<SeenPoint> images = mirrored_on(scene.world, ray, rng);
        const auto wall = scene.world.first_hit({on_level, (on_level - below).normalized()});
        ASSERT_EQ(images.size(), wall ? 1u : 0u);
        if (!wall) continue;
        ++on_wall;
        // Seen from below the level, rounded where the ray crosses it (0.7 m · 1e-16, stretched by the slant).
        EXPECT_LT((images[0].point - wall->point).norm(), 1e-14);
        EXPECT_EQ(images[0].around, nullptr);
        EXPECT_FALSE(images[0].refracted || images[0].entered);
        EXPECT_NEAR(images[0].transmittance, fresnel_reflectance(-ray.direction.z(), 1.0, 1.3281), 1e-15);
        // The wall is a cylinder of 40 mm, of facets that stand up to 3 µm inside.
        const double radius = (images[0].point.head<2>() - Eigen::Vector2d(0.0, 0.300)).norm();
        EXPECT_NEAR(radius, 0.040 - 1.5e-6, 1.6e-6);
      }
    EXPECT_GT(on_wall, 10);
  }
}

TEST(MirrorImage, OfABareDeskThereIsNone) {
  const LitScene scene(desk_setup());
  Rng rng(1);
  EXPECT_TRUE(mirrored_on(scene.world, scene.camera_ray({0.0, 0.4, 0.0}), rng).empty());
}

/// A scene in a closed room, so that every ray ends.
struct Oven {
  explicit Oven(const Setup& setup) : rig(setup.rig), geometry(with_room(setup.scene)), world(geometry) {}

  static Geometry with_room(const Scene& scene) {
    Geometry geometry = build_geometry(scene, 830.0);
    add_room(geometry);
    return geometry;
  }

  /// What a camera's ray gets where every surface sends out the radiance n² of an oven of 1: 1, whatever it passes.
  double radiance(const Ray& ray, Rng& rng) const {
    double sum = 0.0;
    const auto add = [&](const SeenPoint& seen) { sum += seen.transmittance * std::pow(index_of(seen.around), 2); };
    if (const auto seen = see(world, ray)) add(*seen);
    see_mirrored(world, ray, rng, add);
    return sum;
  }

  Rig rig;
  Geometry geometry;
  Intersector world;
};

TEST(Oven, ALevelLiquidReflectsWhatItDoesNotLetThrough) {
  const Oven oven(cup_of(kPaperCup, R"(, "liquid": {"index": 1.3281}, "fill_mm": 30)"));
  Rng rng(1);
  for (double x = -0.06; x < 0.061; x += 0.003)
    for (double y = 0.22; y < 0.381; y += 0.003)
      EXPECT_NEAR(oven.radiance({oven.rig.camera_in_world(),
                                 (Eigen::Vector3d(x, y, kLevel) - oven.rig.camera_in_world()).normalized()},
                                rng),
                  1.0, 1e-14);  // roundings
}

TEST(Oven, GlassAndWavyLiquidsHideAndAddNothing) {
  constexpr const char* kClearGlassCup = R"({"height_mm": 87, "bottom_mm": 7, "inner_radius_mm": 40,
      "outer_radius_mm": 43, "material": {"index": 1.51}})";
  for (const char* surface : {"", kMeniscus, kTilted}) {
    const Oven oven(
        cup_of(kClearGlassCup, fmt::format(R"(, "liquid": {{"index": 1.3281}}, "fill_mm": 30{})", surface)));
    Rng rng(2);
    double sum = 0.0, squares = 0.0;
    int rays = 0;
    for (double x = -0.06; x < 0.061; x += 0.0005)
      for (double y = 0.22; y < 0.381; y += 0.0005, ++rays) {
        const Eigen::Vector3d at(x, y, kLevel), camera = oven.rig.camera_in_world();
        const double one = oven.radiance({camera, (at - camera).normalized()}, rng);
        sum += one, squares += one * one;
      }
    const double mean = sum / rays, error = std::sqrt((squares / rays - mean * mean) / rays);
    EXPECT_LT(error, 2e-5);
    EXPECT_NEAR(mean, 1.0, 4.0 * error) << surface;  // 4 SE: once in 16 000 with a fresh seed
  }
}

}  // namespace mirror_image_test
}  // namespace fathom
