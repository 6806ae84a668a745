// The device's raw shifts and the registration of depth to its colour camera.
#include "sim/sensor/device_outputs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/sensor/depth.h"
#include "tests/render/scenes.h"

namespace fathom {
namespace {

SensorModel sensor_named(const std::string& name) {
  const Json json = {{"model", name}, {"height_mm", 650}, {"pitch_deg", 60}};
  return rig_from_json(JsonReader(json, "test")).sensor;
}

/// OpenNI's shift-to-depth table [mm], in its own words: zero plane distance and emitter's distance in cm.
double openni_depth_mm(int shift, double zpps_cm) {
  const double x = (shift - 4 * 200) / 4.0 - 0.375, metric = x * zpps_cm;
  return std::floor(10.0 * 120.0 * 7.5 / (7.5 - metric));
}

TEST(Shift, IsThatOfOpenNisTable) {
  const std::pair<const char*, double> models[] = {{"xtion_pro_live", 0.1052}, {"kinect_v1", 0.1042}};
  for (const auto& [name, zpps_cm] : models) {
    const SensorModel sensor = sensor_named(name);
    int compared = 0;
    for (int code = -1200; code < 250; ++code) {
      const double x = 8.0 * sensor.focal_px * sensor.baseline;  // steps of 1/8 px
      const double inverse = 1.0 / sensor.reference - (code + 0.5) / x;
      if (inverse <= 0.0 || 1.0 / inverse < sensor.near || 1.0 / inverse > 9.9) continue;
      const Image<float> disparity(1, 1, static_cast<float>(sensor.focal_px * sensor.baseline * inverse));
      const int shift = shift_image(sensor, disparity)(0, 0);
      ASSERT_LT(shift, kNoShift);
      // Depths of the table are whole: those of the law, exactly, but for rounding on an edge between two whole mm.
      ASSERT_NEAR(openni_depth_mm(shift, zpps_cm), mm_from_metres(depth_image(sensor, disparity)(0, 0)), 1e-3)
          << name << " code " << code;
      ++compared;
    }
    EXPECT_GT(compared, 700);
  }
}

TEST(Shift, SaysWhereNothingIsMeasured) {
  const SensorModel sensor = sensor_named("xtion_pro_live");
  Image<float> disparity(2, 1);
  disparity(1, 0) = static_cast<float>(disparity_of_depth(sensor, 0.3));  // nearer than the sensor reaches
  const Image<std::uint16_t> shifts = shift_image(sensor, disparity);
  EXPECT_EQ(shifts(0, 0), 2047);
  EXPECT_EQ(shifts(1, 0), 2047);
}

/// Length of the run of holes that ends before, or begins at, column x.
int holes(const Image<float>& depth, int x, int step) {
  int count = 0;
  for (; x >= 0 && x < depth.width() && depth(x, 0) == 0.0f; x += step) ++count;
  return count;
}

TEST(Registration, SplitsAShadowAsTheCamerasStand) {
  const SensorModel sensor = sensor_named("xtion_pro_live");
  constexpr double kNear = 0.6, kFar = 0.7;
  const double parallax_px = sensor.focal_px * (1.0 / kNear - 1.0 / kFar);  // per metre of baseline
  // As the infrared camera sees an object before a wall: all of the projector's shadow on the left.
  Image<float> depth(sensor.width, 1, static_cast<float>(kFar));
  const int left = 300, right = 400, shadow = static_cast<int>(std::lround(parallax_px * sensor.baseline));
  for (int x = left; x < right; ++x) depth(x, 0) = static_cast<float>(kNear);
  for (int x = left - shadow; x < left; ++x) depth(x, 0) = 0.0f;

  const Image<float> registered = registered_to_colour(sensor, depth);
  int first = 0, last = 0;
  for (int x = 0; x < registered.width(); ++x)
    if (registered(x, 0) == static_cast<float>(kNear)) last = x, first = first > 0 ? first : x;
  EXPECT_EQ(last - first + 1, right - left);
  EXPECT_NEAR(first, left - sensor.focal_px * kColourCamera / kNear, 1.0);  // whole pixels
  // The projector stands 50 mm to the right of the colour camera, the infrared camera 25 mm to its left.
  EXPECT_NEAR(holes(registered, first - 1, -1), parallax_px * 0.050, 1.5);  // three places are rounded to whole pixels
  EXPECT_NEAR(holes(registered, last + 1, 1), parallax_px * 0.025, 1.0);
}

TEST(Registration, TheNearestPointWins) {
  const SensorModel sensor = sensor_named("xtion_pro_live");
  const auto place = [&](int x, float z) {
    return static_cast<int>(std::floor(x + 0.5 - sensor.focal_px * kColourCamera / z));
  };
  const float near = 0.6f, far = 2.0f;
  const int near_x = 320, far_x = near_x + place(near_x, near) - place(near_x, far);
  Image<float> depth(sensor.width, 1);
  depth(near_x, 0) = near;
  depth(far_x, 0) = far;
  ASSERT_EQ(place(far_x, far), place(near_x, near));
  EXPECT_EQ(registered_to_colour(sensor, depth)(place(near_x, near), 0), near);
}

}  // namespace
}  // namespace fathom
