// The device's raw shifts.
#include "sim/sensor/depth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/render/scenes.h"

namespace fathom {
namespace device_outputs_test {

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
      if (inverse <= 0.0 || 1.0 / inverse < sensor.law.near || 1.0 / inverse > 9.9) continue;
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

}  // namespace device_outputs_test
}  // namespace fathom
