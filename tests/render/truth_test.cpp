// Every pixel's true geometry against the exact theory, which shares no optics code with it.
#include "sim/render/truth.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/render/scenes.h"
#include "theory/triangulation.h"

namespace fathom {
namespace {

struct Traced {
  explicit Traced(const Setup& setup)
      : rig(setup.rig),
        geometry(build_geometry(setup.scene, rig.sensor.wavelength_nm)),
        world(geometry),
        truth(trace_truth(PointLight(world, rig.projector_in_world()), rig)) {}

  /// The point that a camera measures at a pixel's centre.
  Eigen::Vector3d measured(int x, int y) const {
    const Eigen::Vector3d in_camera((x + 0.5 - rig.sensor.principal_px.x()) / rig.sensor.focal_px,
                                    (y + 0.5 - rig.sensor.principal_px.y()) / rig.sensor.focal_px, 1.0);
    return rig.world_from_camera * Eigen::Vector3d(in_camera * *truth(x, y).apparent_depth);
  }

  template <class Visit>
  void for_lit_pixels(Visit visit) const {
    for (int y = 0; y < truth.height(); ++y)
      for (int x = 0; x < truth.width(); ++x)
        if (truth(x, y).apparent_depth) visit(x, y, truth(x, y));
  }

  Rig rig;
  Geometry geometry;
  Intersector world;
  Image<TruePixel> truth;
};

/// Exact triangulation of a bottom point as this rig sees it; the theory's bottom is at height 0.
theory::Triangulation theory_at(const Rig& rig, const Filling& filling, const Eigen::Vector3d& bottom) {
  const Eigen::Vector3d forward = rig.world_from_camera.linear().col(2);
  return theory::triangulate({.sensor_height = rig.camera_in_world().z() - kPaperCupBottom,
                              .baseline = rig.sensor.baseline,
                              .fill = filling.depth,
                              .index = filling.medium.n(rig.sensor.wavelength_nm),
                              .lateral = bottom.x(),
                              .distance = bottom.y(),
                              .pitch = std::asin(-forward.z()),
                              .focal_px = rig.sensor.focal_px});
}

TEST(Truth, TheBottomIsRaisedAsTheTheorySays) {
  for (const double distance_mm : {200.0, 300.0, 400.0, 500.0})
    for (const double fill_mm : {10.0, 20.0, 30.0})
      for (const double aim_mm : {400.0, distance_mm}) {
        const auto setup = cup_setup(fill_mm, distance_mm, aim_mm);
        const Traced traced(setup);
        int pixels = 0;
        double worst = 0.0;
        traced.for_lit_pixels([&](int x, int y, const TruePixel& pixel) {
          if (pixel.path != PathKind::refracted || pixel.position.z() > kPaperCupBottom + 1e-9) return;
          const theory::Triangulation exact = theory_at(traced.rig, *setup.scene.cups[0].filling, pixel.position);
          worst =
              std::max(worst, (traced.measured(x, y) - exact.measured - Eigen::Vector3d(0, 0, kPaperCupBottom)).norm());
          ++pixels;
        });
        // 1e-5 mm, the project's bar: everything is double but Embree's choice of the triangle.
        EXPECT_LT(worst, 1e-8) << fill_mm << " mm at " << distance_mm << " mm";
        EXPECT_GT(pixels, 20) << fill_mm << " at " << distance_mm;
      }
}

TEST(Truth, WhatIsDryIsMeasuredWhereItIs) {
  const Traced traced(cup_setup(0.0, 300.0, 400.0));
  double worst = 0.0;
  int bottom = 0, desk = 0;
  traced.for_lit_pixels([&](int x, int y, const TruePixel& pixel) {
    worst = std::max(worst, (traced.measured(x, y) - pixel.position).norm());
    bottom += pixel.object == 2 && std::fabs(pixel.position.z() - kPaperCupBottom) < 1e-9;
    desk += pixel.object == 1;
  });
  EXPECT_LT(worst, 1e-9);  // 1e-6 mm: rounding of the triangulation, 1e-16 · Z² / b
  EXPECT_GT(bottom, 100);
  EXPECT_GT(desk, 100000);
}

/// Point in the world at a depth on a pixel's chief ray.
Eigen::Vector3d on_chief_ray(const Rig& rig, int x, int y, double depth) {
  const Eigen::Vector3d direction = rig.direction_in_world(x + 0.5, y + 0.5);
  return rig.camera_in_world() + direction * (depth / direction.dot(rig.world_from_camera.linear().col(2)));
}

TEST(Truth, ThroughWaterThePixelsMeetItsLevelFirstAndTheCupFinally) {
  auto setup = cup_setup(30.0, 300.0, 300.0);
  const Traced traced(setup);
  ASSERT_EQ(traced.geometry.cups.size(), 1u);
  const int cup = traced.geometry.cups[0].cup, water = *traced.geometry.cups[0].liquid;
  const double level = kPaperCupBottom + 0.030;
  int pixels = 0;
  double worst = 0.0;
  for (int y = 0; y < traced.truth.height(); ++y)
    for (int x = 0; x < traced.truth.width(); ++x) {
      const TruePixel& pixel = traced.truth(x, y);
      if (pixel.path != PathKind::refracted) continue;
      ASSERT_EQ(pixel.first_object, water);
      EXPECT_EQ(pixel.object, cup);
      worst = std::max(worst, std::fabs(on_chief_ray(traced.rig, x, y, pixel.first_depth).z() - level));
      ++pixels;
    }
  EXPECT_GT(pixels, 1000);
  EXPECT_LT(worst, 1e-9);  // rounding of doubles; the contract asks for a micrometre
}

TEST(Truth, WhatIsSeenDirectlyIsMetFirst) {
  // An opaque liquid, cup and desk: no ray bends.
  auto setup = cup_setup(30.0, 300.0, 300.0);
  setup.scene.cups[0].filling->medium.scattering = 1e6;
  const Traced traced(setup);
  const Rig& rig = traced.rig;
  std::array<int, 4> pixels{};
  double worst = 0.0;
  for (const TruePixel& pixel : traced.truth.pixels()) {
    ASSERT_EQ(pixel.object > 0, pixel.first_object > 0);
    if (pixel.first_object == 0) continue;
    ASSERT_EQ(pixel.first_object, pixel.object);
    const double depth = (rig.world_from_camera.inverse() * pixel.position).z();
    worst = std::max(worst, std::fabs(pixel.first_depth - depth));
    ++pixels.at(pixel.object);
  }
  EXPECT_LT(worst, 1e-12);  // rounding
  for (const int object : {1, traced.geometry.cups[0].cup, *traced.geometry.cups[0].liquid})
    EXPECT_GT(pixels.at(object), 1000) << object;
}

TEST(Truth, BehindGlassThatNothingStandsBehindTheGlassIsStillMetFirst) {
  const Traced traced(setup_from_json(Json::parse(R"({
      "sensor": {"height_mm": 60, "pitch_deg": 0}, "desk": null,
      "cups": [{"position_mm": [0, 500], "shape": {"height_mm": 120, "bottom_mm": 5, "inner_radius_mm": 37,
                                                   "outer_radius_mm": 40, "material": {"index": 1.5}}}]})"),
                                      "test"));
  int through = 0;
  for (const TruePixel& pixel : traced.truth.pixels())
    if (pixel.first_object > 0) {
      EXPECT_EQ(pixel.first_object, 1);
      EXPECT_GT(pixel.first_depth, 0.4);
      EXPECT_LT(pixel.first_depth, 0.6);
      through += pixel.object == 0;
    }
  EXPECT_GT(through, 1000);
}

TEST(Truth, BeyondHalfAMetreTheRimHidesTheEmptyCupsBottom) {
  // Over the near rim, 87 mm high at 560 mm, the line of sight falls by 563 mm on 557 mm: it meets the far wall.
  const Traced traced(cup_setup(0.0, 600.0, 600.0));
  for (const TruePixel& pixel : traced.truth.pixels())
    EXPECT_FALSE(pixel.object == 2 && std::fabs(pixel.position.z() - kPaperCupBottom) < 1e-9);
}

/// A box, as a cup without a hollow: 100 mm high, under a sensor that looks straight down.
Setup step_setup() {
  return setup_from_json(Json::parse(R"({
      "sensor": {"model": "xtion_pro_live", "height_mm": 700, "pitch_deg": 90},
      "desk": {"size_mm": [2000, 2000], "centre_mm": [0, 0]},
      "cups": [{"position_mm": [0, 0], "shape": {"height_mm": 100, "bottom_mm": 99.999, "inner_radius_mm": 79,
                                                  "outer_radius_mm": 80}}]})"),
                         "test");
}

TEST(Truth, TheProjectorsShadowLiesLeftOfANearObjectAsWideAsTheParallax) {
  const Traced traced(step_setup());
  const SensorModel& sensor = traced.rig.sensor;
  const int row = 240;
  std::vector<int> shadow, top;
  for (int x = 0; x < sensor.width; ++x) {
    const TruePixel& pixel = traced.truth(x, row);
    if (pixel.object == 1 && !pixel.apparent_depth) shadow.push_back(x);
    if (pixel.object == 2 && pixel.apparent_depth) top.push_back(x);
  }
  ASSERT_FALSE(shadow.empty());
  EXPECT_LT(shadow.back(), top.front());
  EXPECT_EQ(shadow.back() - shadow.front() + 1, static_cast<int>(shadow.size()));  // one piece
  const double expected = sensor.focal_px * sensor.baseline * (1.0 / 0.600 - 1.0 / 0.700);
  EXPECT_NEAR(expected, 10.2, 0.05);
  EXPECT_NEAR(static_cast<double>(shadow.size()), expected, 1.0);  // whole pixels
}

TEST(Truth, NothingIsSeenWhereNothingStands) {
  const Traced traced(
      setup_from_json(Json::parse(R"({"sensor": {"height_mm": 650, "pitch_deg": 0}, "desk": null})"), "test"));
  for (const TruePixel& pixel : traced.truth.pixels()) {
    EXPECT_EQ(pixel.path, PathKind::nothing);
    EXPECT_EQ(pixel.object, 0);
    EXPECT_FALSE(pixel.apparent_depth);
  }
}

TEST(Truth, LightThatLeavesBackwardsHasNoPlaceInAnImage) {
  const Rig rig = desk_setup().rig;
  const Eigen::Vector3d right = rig.world_from_camera.linear().col(0), forward = rig.world_from_camera.linear().col(2);
  const Eigen::Vector3d ahead = (forward + 0.1 * right).normalized(), left = (forward - 0.1 * right).normalized();
  EXPECT_NEAR(rig.rectified(ahead)->x(), 0.1, 1e-12);  // rounding
  EXPECT_FALSE(rig.rectified(-ahead));
  EXPECT_TRUE(triangulated_depth(rig, ahead, left));
  EXPECT_FALSE(triangulated_depth(rig, ahead, -left)) << "its mirror image lies at a depth";
}

}  // namespace
}  // namespace fathom
