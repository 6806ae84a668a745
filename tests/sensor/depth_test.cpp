// The device's depth law, as recorded depth shows it, and its raw shifts.
#include "sim/sensor/depth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/render/scenes.h"

namespace fathom {
namespace depth_test {

SensorModel sensor_named(const std::string& name) {
  const Json json = {{"model", name}, {"height_mm", 650}, {"pitch_deg", 60}};
  return rig_from_json(JsonReader(json, "test")).sensor;
}

struct PrintedLaw {
  const char* model;
  double p;

  /// z before truncation, 1 / (1/1200 − (n + ½) p / 36000) [mm]; `n` may lie between codes.
  double exact_mm(double n) const { return 1.0 / (1.0 / 1200.0 - (n + 0.5) * p / 36000.0); }
};
constexpr PrintedLaw kLaws[] = {{"xtion_pro_live", 0.1052}, {"kinect_v1", 0.1042}};

/// Calls `visit(code, exact depth [mm])` for every code from 0.3 to 10 m.
template <class Visit>
void for_codes(const PrintedLaw& law, Visit visit) {
  int codes = 0;
  for (int n = -2000; n < 284; ++n) {
    const double z_mm = law.exact_mm(n);
    if (z_mm < 300.0 || z_mm > 10000.0) continue;
    visit(n, z_mm);
    ++codes;
  }
  EXPECT_GT(codes, 1000);
}

TEST(DepthLaw, IsThePrintedOneForEveryCode) {
  for (const PrintedLaw& law : kLaws) {
    const SensorModel sensor = sensor_named(law.model);
    for_codes(law, [&](int n, double z_mm) {
      const auto depth = device_depth(sensor, n);
      ASSERT_TRUE(depth);
      ASSERT_NEAR(mm_from_metres(*depth), std::floor(z_mm), 1e-9) << law.model << " code " << n;  // whole mm
    });
  }
}

TEST(DepthLaw, IsCutToTenthsOfMillimetresOnTheFinerOutput) {
  const double tenth_mm = 1e-4;
  for (const PrintedLaw& law : kLaws) {
    const SensorModel sensor = sensor_named(law.model);
    for_codes(law, [&](int n, double z_mm) {
      const double tenths = *device_depth(sensor, n, tenth_mm) / tenth_mm;
      ASSERT_NEAR(tenths, std::round(tenths), 1e-8) << law.model << " code " << n;  // rounding of 1e5 tenths to double
      ASSERT_NEAR(tenths + 0.5, 10.0 * z_mm, 0.5 + 1e-8) << law.model << " code " << n;  // cut, not rounded
    });
  }
}

TEST(DepthInUnits, IsTheNearestWholeNumberAndNothingWhere16BitsEnd) {
  Image<float> depth(4, 1);
  depth(1, 0) = 0.7126f;
  depth(2, 0) = 6.5535f;
  depth(3, 0) = 6.5536f;
  const Image<std::uint16_t> mm = depth_in_units(depth, 1e-3), tenths = depth_in_units(depth, 1e-4);
  EXPECT_EQ((std::vector(mm.pixels().begin(), mm.pixels().end())), (std::vector<std::uint16_t>{0, 713, 6554, 6554}));
  EXPECT_EQ((std::vector(tenths.pixels().begin(), tenths.pixels().end())),
            (std::vector<std::uint16_t>{0, 7126, 65535, 0}));
}

TEST(DepthLaw, CodeIsTheInverseOfDepth) {
  for (const PrintedLaw& law : kLaws) {
    const SensorModel sensor = sensor_named(law.model);
    for_codes(law, [&](int n, double z_mm) {
      ASSERT_EQ(device_code(sensor, metres_from_mm(z_mm)), n);
      // What lies up to half a step away in disparity has the same code.
      ASSERT_EQ(device_code(sensor, metres_from_mm(law.exact_mm(n - 0.49))), n);
      ASSERT_EQ(device_code(sensor, metres_from_mm(law.exact_mm(n + 0.49))), n);
    });
  }
}

TEST(DepthLaw, StepsGrowWithTheSquareOfDepth) {
  const SensorModel sensor = sensor_named("xtion_pro_live");
  const std::pair<double, double> steps[] = {{0.5, 0.72}, {0.6, 1.05}, {0.7, 1.43}, {0.8, 1.87},
                                             {1.0, 2.9},  {2.0, 11.6}, {4.0, 46.0}};
  for (const auto& [depth, step_mm] : steps) {
    const int code = device_code(sensor, depth);
    const double mean_mm = mm_from_metres(*device_depth(sensor, code + 10) - *device_depth(sensor, code - 10)) / 20.0;
    // Truncation to whole mm leaves ±1 mm over the 20 codes. The published steps are rounded (46 stands for 46.8) and
    // z's curvature over 20 codes adds 1.4 % at 4 m: 3 % together.
    EXPECT_NEAR(mean_mm / step_mm, 1.0, 0.05 / step_mm + 0.03) << depth;
  }
}

TEST(DepthLaw, BeyondInfinityThereIsNoDepth) { EXPECT_FALSE(device_depth(sensor_named("kinect_v1"), 300)); }

TEST(DepthImage, IsFloatWithoutQuantisationAndEmptyOutsideTheRange) {
  SensorModel sensor = sensor_named("xtion_pro_live");
  sensor.law.quantized = false;
  Image<float> disparity(4, 1);
  disparity(0, 0) = static_cast<float>(disparity_of_depth(sensor, 0.7123));
  disparity(1, 0) = static_cast<float>(disparity_of_depth(sensor, 0.39));
  disparity(2, 0) = static_cast<float>(disparity_of_depth(sensor, 10.1));
  const Image<float> depth = depth_image(sensor, disparity);
  EXPECT_NEAR(depth(0, 0), 0.7123, 2e-7);  // two roundings to float
  EXPECT_EQ(depth(1, 0), 0.0f);            // nearer than 0.4 m
  EXPECT_EQ(depth(2, 0), 0.0f);            // farther than 10 m
  EXPECT_EQ(depth(3, 0), 0.0f);            // no disparity
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

TEST(Cloud, PointsLieOnTheirPixelsRays) {
  const SensorModel sensor = sensor_named("xtion_pro_live");
  Image<float> depth(sensor.width, sensor.height), intensity(sensor.width, sensor.height, 7.0f);
  depth(0, 0) = 1.0f;
  const Image<CloudPoint> cloud = cloud_of_depth(sensor, depth, intensity);
  EXPECT_FLOAT_EQ(cloud(0, 0).x, static_cast<float>((0.5 - 320.0) / sensor.focal_px));
  EXPECT_FLOAT_EQ(cloud(0, 0).y, static_cast<float>((0.5 - 240.0) / sensor.focal_px));
  EXPECT_EQ(cloud(0, 0).z, 1.0f);
  EXPECT_TRUE(std::isnan(cloud(1, 0).x) && std::isnan(cloud(1, 0).y) && std::isnan(cloud(1, 0).z));
  EXPECT_EQ(cloud(1, 0).intensity, 7.0f);
}

}  // namespace depth_test
}  // namespace fathom
