// The projector's mirror image in the infrared image.
#include "sim/sensor/glints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/optics/fresnel.h"
#include "sim/render/radiance.h"
#include "sim/sensor/ir_camera.h"
#include "tests/render/scenes.h"

namespace fathom {
namespace {

/// A sensor that looks straight down into a black cup of water, on nothing, so that it sees no light but the glint.
/// This pattern has a dot where the projector's light is mirrored into the camera.
struct Pool {
  static constexpr double kHeight = 0.650, kLevel = 0.037, kIndex = 1.3281;

  Pool()
      : scene(setup_from_json(Json::parse(R"({"sensor": {"height_mm": 650, "pitch_deg": 90, "depth_size_px": [320, 240],
                                       "ir_size_px": [640, 512], "pattern": {"seed": 3}},
                            "desk": null,
                            "cups": [{"shape": {"height_mm": 87, "bottom_mm": 7, "inner_radius_mm": 40,
                                                "outer_radius_mm": 43, "albedo": 0},
                                      "position_mm": [0, 0], "fill_mm": 30, "liquid": {"index": 1.3281}}]})"),
                              "test")),
        pattern(scene.rig.sensor.pattern, scene.rig.sensor.ir_scale()),
        image(scene.rig.sensor.ir_width, scene.rig.sensor.ir_height) {}

  LitScene scene;
  Pattern pattern;
  Image<float> image;
};

TEST(Glints, AreAsBrightAsTheProjectorInAMirror) {
  Pool pool;
  const Rig& rig = pool.scene.rig;
  add_glints(pool.scene.projector, rig, pool.pattern, pool.image);
  // Level by level: the light goes down half a baseline aside of the camera's middle and up again.
  const double down = Pool::kHeight - Pool::kLevel, across = rig.sensor.baseline;
  const double squared = 4.0 * down * down + across * across, cosine = 2.0 * down / std::sqrt(squared);
  const double intensity = pool.pattern.intensity(pool.pattern.on_grid(-0.5 * across / down, 0.0, rig.sensor.focal_px));
  ASSERT_GT(intensity, 0.1);
  const double irradiance = intensity * fresnel_reflectance(cosine, 1.0, Pool::kIndex) / squared;  // on the pinhole
  const double focal_ir_px = rig.sensor.ir_scale() * rig.sensor.focal_px;
  double received = 0.0;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  for (int y = 0; y < pool.image.height(); ++y)
    for (int x = 0; x < pool.image.width(); ++x) {
      const Eigen::Vector2d at(x + 0.5, y + 0.5);
      const Eigen::Vector2d off = (at - 0.5 * Eigen::Vector2d(pool.image.width(), pool.image.height())) / focal_ir_px;
      const double pixel = std::pow(off.homogeneous().norm(), -3.0) / (focal_ir_px * focal_ir_px);
      received += pool.image(x, y) * pixel;
      centre += pool.image(x, y) * pixel * at;
    }
  centre /= received;
  // A pixel's solid angle changes by 0.2 % along the spot, evenly but for its square; pixels are floats.
  EXPECT_NEAR(received / radiance_dn(rig.sensor, std::numbers::pi * irradiance), 1.0, 1e-5);
  EXPECT_NEAR(centre.x(), 320.0 + focal_ir_px * 0.5 * across / down, 1e-3);
  EXPECT_NEAR(centre.y(), 256.0, 1e-3);
}

TEST(Glints, AreSeenInFullLightOnly) {
  Pool pool;
  const auto brightest = [&](LightModel light) {
    const Image<float> image = render_ir(pool.scene.projector, pool.scene.rig, pool.pattern, 1, light, 1).projected;
    return *std::max_element(image.pixels().begin(), image.pixels().end());
  };
  add_glints(pool.scene.projector, pool.scene.rig, pool.pattern, pool.image);
  EXPECT_EQ(brightest(LightModel::direct), 0.0f);
  EXPECT_EQ(brightest(LightModel::full), *std::max_element(pool.image.pixels().begin(), pool.image.pixels().end()));
}

}  // namespace
}  // namespace fathom
