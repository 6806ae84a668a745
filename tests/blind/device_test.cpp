// The blind world's device against facts measured on real ones.
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <array>
#include <cmath>
#include <set>

#include "blind/device_frames.h"
#include "blind/device_law.h"
#include "blind/eye.h"
#include "blind/laboratory.h"

namespace fathom::blind {
namespace {

TEST(BlindDevice, DepthsAreThoseOfTheTable) {
  // Steps of 0.72 mm at 0.5 m and 1.43 at 0.7 m, as published.
  EXPECT_NEAR(1e6 * (1.0 / (disparity_of(0.5) - 0.125) * disparity_of(0.5) * 0.5 - 0.5) / 1e3, 0.72, 0.02);
  std::set<double> table;
  for (int n = -700; n < 300; ++n) table.insert(depth_of_step(n));
  const Placement placement{.liquid = "water", .fill = 0.02, .distance = 0.3, .lateral = 0.12};
  World world = believed(placement);
  const Raster raster = near_cup(placement);
  for (const double steps : {8.0, 2.0}) {
    world.sensor.steps_per_px = steps;
    const Scene scene = stand(world, dots_for(world.sensor, raster, 0.45, 1.0), true, raster, 1);
    std::vector<CloudPoint> cloud;
    append_points(scene, world, shake_of(world, 2), 2, nullptr, cloud);
    ASSERT_GT(cloud.size(), 1000u);
    for (const CloudPoint& point : cloud) {
      const double mm = std::round(1000.0 * point.z);
      EXPECT_NEAR(1000.0 * point.z, mm, 1e-4);  // float
      EXPECT_TRUE(table.contains(1e-3 * mm)) << mm;
    }
  }
}

TEST(BlindDevice, OnItsReferencePlaneAnyUnitReadsThatDistance) {
  // What lies there looks as it is remembered, however the unit was built.
  Sensor sensor;
  sensor.baseline = 0.0764, sensor.focal_px = 575.0, sensor.pitch = 0.0;
  const Eyes eyes = eyes_of(sensor);
  const Eigen::Vector2d of_projector(250.0, 200.0);
  const Eigen::Vector3d along = projector_direction(eyes, of_projector);
  const Eigen::Vector3d there = eyes.projector + 1e-3 * kReferenceMm / along.y() * along;  // level: y is forward
  const double u = camera_pixel(eyes, sensor, there - eyes.camera).x();
  EXPECT_NEAR(kTableFocalPx * kTableBaseline / disparity_seen(sensor, of_projector, u), 1e-3 * kReferenceMm, 1e-9);
}

TEST(BlindDevice, QuantisesWithoutBiasButForWholeMillimetres) {
  double sum = 0.0;
  int count = 0;
  for (double depth = 0.6; depth < 0.8; depth += 1.37e-6, ++count) sum += device_depth(disparity_of(depth)) - depth;
  EXPECT_NEAR(sum / count, -0.5e-3, 0.05e-3);  // the table cuts to millimetres
}

/// Deviation in steps and correlations of windows of 31 × 31 pixels, their planes removed, as they were measured.
struct Noise {
  double sigma;
  std::array<double, 4> along_x;  // 1, 2, 4, 8 px
  std::array<double, 3> along_y;  // 1, 2, 4 px
};

Noise desk_noise(double height) {
  World world;
  world.sensor.height = height;
  world.sensor.pitch = 1.0;  // desks are looked at from above, not straight down
  constexpr int kSide = 31;
  double variance = 0.0;
  std::array<double, 4> x{};
  std::array<double, 3> y{};
  constexpr std::array kLagsX{1, 2, 4, 8};
  constexpr std::array kLagsY{1, 2, 4};
  int windows = 0;
  for (int v = 150; v <= 290; v += 35)
    for (int u = 150; u <= 450; u += 50, ++windows) {
      const Raster raster{{u, v}, {u + kSide, v + kSide}, 1};
      const Scene scene = stand(world, dots_for(world.sensor, raster, 0.3, 4.0), false, raster, 7);
      EXPECT_EQ(scene.matched.blocks.size(), static_cast<std::size_t>(kSide * kSide));
      const std::vector<double> px = disparities(scene, world, shake_of(world, 3), 3);
      Eigen::MatrixXd plane(kSide * kSide, 3);
      Eigen::VectorXd steps(kSide * kSide);
      for (int i = 0; i < kSide * kSide; ++i) {
        plane.row(i) << 1.0, i % kSide, i / kSide;
        steps[i] = std::floor(8.0 * px[static_cast<std::size_t>(i)]);
      }
      const Eigen::VectorXd rest = steps - plane * plane.householderQr().solve(steps);
      const auto at = [&](int i, int j) { return rest[j * kSide + i]; };
      const auto product = [&](int dx, int dy) {
        double sum = 0.0;
        for (int j = 0; j + dy < kSide; ++j)
          for (int i = 0; i + dx < kSide; ++i) sum += at(i, j) * at(i + dx, j + dy);
        return sum / ((kSide - dx) * (kSide - dy));
      };
      variance += product(0, 0);
      for (std::size_t k = 0; k < x.size(); ++k) x[k] += product(kLagsX[k], 0);
      for (std::size_t k = 0; k < y.size(); ++k) y[k] += product(0, kLagsY[k]);
    }
  for (double& value : x) value /= variance;
  for (double& value : y) value /= variance;
  return {std::sqrt(variance / windows), x, y};
}

TEST(BlindDevice, NoiseOfADeskIsThatOfRealDesks) {
  // Recorded Kinect desks: 0.77 steps at 0.65 m, falling to 0.64 from 1 m; the desks' slopes are not known, which
  // decide a third of it: ± 0.15.
  EXPECT_NEAR(desk_noise(0.55).sigma, 0.77, 0.15);
  EXPECT_NEAR(desk_noise(0.85).sigma, 0.64, 0.15);
}

TEST(BlindDevice, NoiseIsCorrelatedAsOnRealDesks) {
  const Noise noise = desk_noise(0.55);
  constexpr std::array kMeasuredX{0.71, 0.57, 0.36, 0.05};
  constexpr std::array kMeasuredY{0.55, 0.31, -0.03};
  // The windows hold some 400 independent blocks, so a correlation is known to 0.05; the desks' slopes are not known.
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(noise.along_x[k], kMeasuredX[k], 0.15) << k;
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(noise.along_y[k], kMeasuredY[k], 0.15) << k;
}

TEST(BlindDevice, ErrorsThatStandAreSharedByFramesOfOnePlacementOnly) {
  const Placement placement{.liquid = "none"};
  const World world = believed(placement);
  const Raster raster{{200, 200}, {260, 260}, 10};
  const auto dots = dots_for(world.sensor, raster, 0.45, 1.25);
  const Scene one = stand(world, dots, false, raster, 1), other = stand(world, dots, false, raster, 2);
  EXPECT_NE(one.standing_px, other.standing_px);
  const auto first = disparities(one, world, shake_of(world, 1), 1),
             second = disparities(one, world, shake_of(world, 2), 2);
  double spread = 0.0;
  for (std::size_t i = 0; i < first.size(); ++i) spread += std::pow(first[i] - second[i], 2) / 2.0;
  // The errors of the four dots in the middle rows of a window; there are from one to eight.
  EXPECT_NEAR(std::sqrt(spread / static_cast<double>(first.size())), kTemporalDotPx / 2.0, 0.012);
}

TEST(BlindDevice, UnitsAreOffAsAKinectIs) {
  // 200 units of half to one and a half times 0.1 px: in the root mean square 0.104 px over the image.
  double squares = 0.0;
  int count = 0;
  for (int unit = 0; unit < 200; ++unit) {
    const UnitBias bias = draw_unit(unit);
    for (double y = 20.0; y < 480.0; y += 40.0)
      for (double x = 20.0; x < 640.0; x += 40.0, ++count) squares += std::pow(unit_px(bias, {x, y}), 2);
  }
  EXPECT_NEAR(std::sqrt(squares / count), 0.104, 0.006);
}

TEST(BlindDevice, AUnitsBiasIsTheSameInEveryFrameAndGoesWithTheDots) {
  const Placement first{.number = 0, .session = 0, .liquid = "none"},
      later{.number = 7, .session = 2, .liquid = "none"};
  World world;
  world.unit = true_world(first, 5, 1.0).unit;
  EXPECT_EQ(world.unit, true_world(later, 5, 1.0).unit);
  EXPECT_NE(world.unit, true_world(first, 6, 1.0).unit);
  // Nearer by 10 px a dot is seen 10 px to the right, and remembered where it was.
  EXPECT_NEAR(field_px(world, {300.0, 200.0}, 50.0), field_px(world, {310.0, 200.0}, 60.0), 1e-12);
}

}  // namespace
}  // namespace fathom::blind
