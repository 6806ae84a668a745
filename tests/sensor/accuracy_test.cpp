// What a user measures: the mean height inside the cup above the desk plane fitted in the same cloud, without noise,
// against the exact triangulation of the same pixels; and how much of the image is measured at all.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "sim/sensor/capture.h"
#include "sim/sensor/depth.h"
#include "tests/render/scenes.h"

namespace fathom {
namespace accuracy_test {

struct Plane {
  Eigen::Vector3d normal;  ///< camera frame, towards the sensor
  double offset;           ///< normal · x on the plane

  double height(const Eigen::Vector3d& point) const { return normal.dot(point) - offset; }
};

Eigen::Vector3d position(const CloudPoint& point) { return {point.x, point.y, point.z}; }

/// Least squares through the desk's points, without mismatches beyond 10 mm.
Plane fit_desk(const Image<CloudPoint>& cloud, const Image<TruePixel>& truth) {
  std::vector<Eigen::Vector3d> points;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const TruePixel& pixel = truth.pixels()[i];
    const CloudPoint& point = cloud.pixels()[i];
    if (pixel.object != 1 || !pixel.apparent_depth || !(std::fabs(point.z - *pixel.apparent_depth) < 0.010)) continue;
    points.push_back(position(point));
    mean += points.back();
  }
  mean /= static_cast<double>(points.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& point : points) scatter += (point - mean) * (point - mean).transpose();
  Eigen::Vector3d normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors().col(0);
  if (normal.dot(mean) > 0.0) normal = -normal;
  return {normal, normal.dot(mean)};
}

/// Mean heights [mm] over the pixels that look at the bottom within 30 mm of the axis.
struct BottomHeights {
  int pixels = 0;
  double measured = 0.0;         ///< float depth
  double exact = 0.0;            ///< triangulation of the same pixels, above the true desk
  double device = 0.0;           ///< the same disparities on the device's law
  double exact_on_device = 0.0;  ///< the exact disparities on the device's law, above the device's desk
};

BottomHeights measure_bottom(double fill_mm, double distance_mm) {
  Setup setup = cup_setup(fill_mm, distance_mm, distance_mm, R"(, "noise": "off", "quantization": "off")");
  Camera camera(setup, CaptureMode::photometric, 4, 1);
  const Frame frame = camera.shoot(0);
  const Image<TruePixel>& truth = camera.truth();
  SensorModel& sensor = setup.rig.sensor;
  sensor.law.quantized = true;
  const Image<CloudPoint> device = cloud_of_depth(sensor, depth_image(sensor, frame.disparity_px), frame.depth);
  const Plane desk = fit_desk(frame.cloud, truth), device_desk = fit_desk(device, truth);

  BottomHeights sum;
  for (int y = 0; y < truth.height(); ++y)
    for (int x = 0; x < truth.width(); ++x) {
      const TruePixel& pixel = truth(x, y);
      const CloudPoint &point = frame.cloud(x, y), &on_device = device(x, y);
      if (!pixel.apparent_depth || std::isnan(point.z) || std::isnan(on_device.z)) continue;
      if (pixel.position.z() > kPaperCupBottom + 1e-9 || pixel.object == 1) continue;
      const Eigen::Vector3d in_world = setup.rig.world_from_camera * position(point);
      if (std::hypot(in_world.x(), in_world.y() - metres_from_mm(distance_mm)) > 0.030) continue;
      const Eigen::Vector3d ray((x + 0.5 - sensor.principal_px.x()) / sensor.focal_px,
                                (y + 0.5 - sensor.principal_px.y()) / sensor.focal_px, 1.0);
      const double law_depth = *device_depth(sensor, device_code(sensor, *pixel.apparent_depth));
      ++sum.pixels;
      sum.measured += mm_from_metres(desk.height(position(point)));
      sum.exact += mm_from_metres((setup.rig.world_from_camera * Eigen::Vector3d(ray * *pixel.apparent_depth)).z());
      sum.device += mm_from_metres(device_desk.height(position(on_device)));
      sum.exact_on_device += mm_from_metres(device_desk.height(ray * law_depth));
    }
  for (double* value : {&sum.measured, &sum.exact, &sum.device, &sum.exact_on_device})
    *value /= std::max(sum.pixels, 1);
  return sum;
}

struct Condition {
  double fill_mm, distance_mm;
  double device_bound_mm;  ///< the device's law against the exact disparities on the same law
};

// The device's law itself moves the mean of the *exact* disparities by −0.25 … +0.17 mm (a step is 0.7 to 1.5 mm, and a
// level bottom meets few codes), so no matcher could come within 0.15 mm of the theory there. What can be asked is that
// measured and exact disparities agree after the same law. The pixels of a row share one exact disparity; where it lies
// within the matching error of a code's edge, the whole row may change sides. At 400 mm the rim leaves 245 to 378
// pixels, a row is up to 32 of them, and 32 / 245 of a step is 0.20 mm.
constexpr Condition kConditions[] = {
    {0, 200, 0.05},  {0, 300, 0.05},  {0, 400, 0.20},   //
    {10, 200, 0.05}, {10, 300, 0.05}, {10, 400, 0.15},  //
    {20, 200, 0.05}, {20, 300, 0.05}, {20, 400, 0.15},  //
    {30, 200, 0.05}, {30, 300, 0.05}, {30, 400, 0.15},
};

class BottomHeight : public testing::TestWithParam<Condition> {};

TEST_P(BottomHeight, IsTheTheorys) {
  const Condition& condition = GetParam();
  const BottomHeights heights = measure_bottom(condition.fill_mm, condition.distance_mm);
  ASSERT_GE(heights.pixels, 150);
  EXPECT_NEAR(heights.measured, heights.exact, 0.05);  // [mm] promised
  EXPECT_NEAR(heights.device, heights.exact_on_device, condition.device_bound_mm);
}

INSTANTIATE_TEST_SUITE_P(Conditions, BottomHeight, testing::ValuesIn(kConditions), [](const auto& instance) {
  return fmt::format("{:g}mm_at_{:g}mm", instance.param.fill_mm, instance.param.distance_mm);
});

TEST(BareDesk, IsMeasuredAlmostEverywhereWithAndWithoutNoise) {
  for (const char* noise : {R"(, "noise": "off")", R"(, "noise": "basic")"}) {
    Camera camera(desk_setup(noise), CaptureMode::photometric, 4, 1);
    const Frame frame = camera.shoot(0);
    double valid = 0.0;
    for (const float depth : frame.depth.pixels()) valid += depth > 0.0f;
    // Promised: 99 % of all pixels, borders included. 300000 pixels, so the noise's draw does not matter.
    EXPECT_GE(valid / static_cast<double>(frame.depth.size()), 0.99) << noise;
  }
}

TEST(NoisyCapture, EveryDepthLiesOnTheDevicesLaw) {
  const auto setup = cup_setup(20.0, 300.0, 300.0, R"(, "noise": "basic")");
  Camera camera(setup, CaptureMode::photometric, 4, 1);
  const Frame frame = camera.shoot(0);
  int valid = 0;
  for (const float depth : frame.depth.pixels()) {
    if (depth == 0.0f) continue;
    ++valid;
    // The nearest code's depth, or a neighbour's where truncation to whole mm crosses half a step.
    const int code = device_code(setup.rig.sensor, depth);
    bool on_law = false;
    for (int n = code - 2; n <= code + 2; ++n)
      on_law = on_law || depth == static_cast<float>(*device_depth(setup.rig.sensor, n));
    ASSERT_TRUE(on_law) << depth;
  }
  EXPECT_GT(valid, 200000);
}

TEST(Capture, GeometricDepthIsTheExactDepthOnTheDevicesLaw) {
  const auto setup = cup_setup(20.0, 300.0, 300.0);
  Camera camera(setup, CaptureMode::geometric, 1, 1);
  const Frame frame = camera.shoot(0);
  EXPECT_TRUE(frame.ir.empty());
  int different = 0;
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    const auto apparent = camera.truth().pixels()[i].apparent_depth;
    if (!apparent) {
      EXPECT_EQ(frame.depth.pixels()[i], 0.0f);
      continue;
    }
    const SensorModel& sensor = setup.rig.sensor;
    different += frame.depth.pixels()[i] != static_cast<float>(*device_depth(sensor, device_code(sensor, *apparent)));
  }
  EXPECT_LT(different, 30);  // disparities are float: 1 in 1e5 may fall over the edge of a step
}

}  // namespace accuracy_test
}  // namespace fathom
