// The blind world's light against Fathom's theory, the paper's printed facts and the laws that it does not use.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "blind/device_law.h"
#include "blind/eye.h"
#include "blind/fermat.h"
#include "blind/follow.h"
#include "blind/height_field.h"
#include "blind/turbid.h"
#include "theory/triangulation.h"

namespace fathom::blind {
namespace {

/// A cup so wide that its walls hide nothing.
World wide_cup(double distance, double fill, double index) {
  World world;
  world.sensor.pitch = std::atan2(world.sensor.height, distance);
  world.cup = {.centre = {0.0, distance}, .height = 0.1, .inner_radius = 0.2, .outer_radius = 0.21, .bottom = 0.0};
  world.fill = fill;
  if (fill > 0.0) world.liquid = Liquid{.index = index};
  return world;
}

/// Height above the bottom that the device, without its steps, gives for a point of the bottom.
double measured_height(const World& world, const Eigen::Vector3d& point) {
  const Eyes eyes = eyes_of(world.sensor);
  const auto towards = [&](const Eigen::Vector3d& eye) -> Eigen::Vector3d {
    if (world.fill == 0.0) return point - eye;
    return least_path(world, eye, point).value() - eye;
  };
  const Eigen::Vector2d pixel = camera_pixel(eyes, world.sensor, towards(eyes.camera));
  const Eigen::Vector2d of_projector = camera_pixel(eyes, world.sensor, towards(eyes.projector));
  const double depth = kTableFocalPx * kTableBaseline / disparity_seen(world.sensor, of_projector, pixel.x());
  return (eyes.camera + eyes.world_from_camera * cloud_point(pixel, depth)).z();
}

TEST(BlindLight, RaisesTheBottomAsTheExactTheoryDoes) {
  for (const double distance : {0.2, 0.4, 0.6})
    for (const double fill : {0.01, 0.03})
      for (const double lateral : {0.0, 0.08}) {
        const World world = wide_cup(distance, fill, 1.333);
        theory::TriangulationSetup setup{.fill = fill, .lateral = lateral, .distance = distance};
        setup.pitch = world.sensor.pitch;
        // Least paths are found to a micrometre; a micrometre sideways is at most ten of height (f b / Z² per pixel).
        EXPECT_NEAR(measured_height(world, {lateral, distance, 0.0}), theory::triangulate(setup).height, 1e-5)
            << distance << " " << fill << " " << lateral;
      }
}

TEST(BlindLight, RaisesMoreWithDistanceAndDepthAndMilkNotAtAll) {
  double before = 0.0;
  for (const double distance : {0.2, 0.3, 0.4, 0.5}) {
    const double height = measured_height(wide_cup(distance, 0.03, 1.333), {0.0, distance, 0.0});
    EXPECT_GT(height, before);
    EXPECT_GT(height, measured_height(wide_cup(distance, 0.02, 1.333), {0.0, distance, 0.0}));
    before = height;
    // An opaque surface is where it is.
    EXPECT_NEAR(measured_height(wide_cup(distance, 0.0, 1.0), {0.0, distance, 0.03}), 0.03, 1e-9);
  }
}

TEST(BlindLight, ShowsFoamWhereItsTopIs) {
  World world = wide_cup(0.3, 0.02, 1.33);
  world.top.foam_cover = 1.0, world.top.foam_thickness = 0.005;
  const Eyes eyes = eyes_of(world.sensor);
  std::vector<SeenDot> seen;
  for (const int u : {180, 300, 420}) follow(world, eyes, {{u, 240}, 0}, true, seen);
  ASSERT_EQ(seen.size(), 3u);
  for (const SeenDot& dot : seen) {
    EXPECT_EQ(dot.lit, Lit::surface);
    const double depth = kTableFocalPx * kTableBaseline / dot.disparity_px;
    EXPECT_NEAR((eyes.camera + eyes.world_from_camera * cloud_point(dot.pixel, depth)).z(), 0.025, 1e-9);
  }
}

World uneven_cup() {
  World world = wide_cup(0.3, 0.03, 1.33);
  world.cup.inner_radius = 0.04;
  world.top.contact_angle = 0.6;
  world.top.slope_y = 0.02;
  world.top.ripple_amplitude = 1e-4;
  return world;
}

TEST(BlindLight, OfLeastTimeObeysSnellsLawOnUnevenSurfaces) {
  const World world = uneven_cup();
  const Eigen::Vector3d eye(-0.0375, 0.0, 0.65), point(0.01, 0.31, 0.0);
  const Eigen::Vector3d surface = least_path(world, eye, point).value();
  const Slope slope = liquid_top(world, surface.head<2>() - world.cup.centre);
  const Eigen::Vector3d normal = Eigen::Vector3d(-slope.dx, -slope.dy, 1.0).normalized();
  const Eigen::Vector3d in = (surface - eye).normalized(), out = (point - surface).normalized();
  // n × (…) of both sides; a crossing that is off by 1e-6 m changes it by 1e-6 / 0.03 m.
  EXPECT_LT((normal.cross(in) - 1.33 * normal.cross(out)).norm(), 4e-5);
}

TEST(BlindLight, TakesNoShorterWayNearby) {
  World world = uneven_cup();
  world.liquid->deep_index_excess = 0.02;
  const Eigen::Vector3d eye(0.0375, 0.0, 0.65), point(-0.02, 0.29, 0.0);
  const Eigen::Vector2d crossing = least_path(world, eye, point).value().head<2>();
  const double least = optical_path(world, eye, crossing, point);
  for (const Eigen::Vector2d& off : {Eigen::Vector2d(1e-4, 0), {-1e-4, 0}, {0, 1e-4}, {0, -1e-4}})
    EXPECT_GT(optical_path(world, eye, crossing + off, point), least);
}

TEST(BlindLight, DotsArriveWhereThePathOfLeastTimeStarts) {
  // Dots are bent by the phase along the surface; the way back to the projector is that of least time.
  World world = uneven_cup();
  const Eyes eyes = eyes_of(world.sensor);
  int checked = 0;
  for (const Dot& dot : dots_in({250, 220}, {290, 260})) {
    std::vector<SeenDot> seen;
    follow(world, eyes, dot, true, seen);
    for (const SeenDot& one : seen) {
      if (one.lit != Lit::bottom) continue;
      // With eyes exchanged the same two ways are gone backwards: the sensor sees the dot under minus its disparity.
      World turned = world;
      turned.sensor.baseline = -world.sensor.baseline;
      std::vector<SeenDot> back;
      follow(turned, eyes_of(turned.sensor), {one.pixel, 0}, true, back);
      ASSERT_EQ(back.size(), 1u);
      // Epipolar lines are missed by refraction, places are not: 1e-6 m at 0.65 m is 1e-3 px.
      EXPECT_LT((back[0].pixel - dot.at).norm(), 2e-3);
      ++checked;
    }
  }
  EXPECT_GT(checked, 20);
}

TEST(BlindLight, TurbidShiftEndsInTheFarField) {
  const double n = 1.34;
  // Core of 50 free paths: all light; the walk's 2e4 photons know the centroid to some 3 %.
  EXPECT_NEAR(turbid_shift(n, 1000.0, 0.05) / (1.0 / (n * 1000.0)), 1.0, 0.1);
  EXPECT_NEAR(turbid_contrast(1000.0, 0.05), 1.0, 0.05);
  // A sharp core follows less of the shift and holds less of the light.
  EXPECT_LT(turbid_shift(n, 1000.0, 0.0005), turbid_shift(n, 1000.0, 0.005));
  EXPECT_LT(turbid_contrast(1000.0, 0.0005), 0.5);
}

}  // namespace
}  // namespace fathom::blind
