// Matching finds the disparity that was rendered, and cares for neither brightness nor offset.
#include "sim/sensor/match.h"

#include <gtest/gtest.h>

#include "sim/sensor/depth.h"
#include "sim/sensor/ir_camera.h"
#include "tests/render/scenes.h"

namespace fathom {
namespace {

/// A noiseless sensor that looks straight down on a plane, and its memorised reference.
struct Bench {
  explicit Bench(double height_mm)
      : setup(setup_from_json(
            Json::parse(fmt::format(
                R"({{"sensor": {{"model": "xtion_pro_live", "height_mm": {}, "pitch_deg": 90, "noise": "off"}},
                     "desk": {{"size_mm": [6000, 6000], "centre_mm": [0, 0]}}}})",
                height_mm)),
            "test")),
        pattern(sensor().pattern, sensor().ir_scale()) {
    const int margin = reference_margin(sensor().matcher);
    reference = memorise(sensor(), reference_image(sensor(), pattern, margin, 2), margin);
    const Geometry geometry = build_geometry(setup.scene, sensor().wavelength_nm);
    const Intersector world(geometry);
    ir = render_ir(PointLight(world, setup.rig.projector_in_world()), setup.rig, pattern, 2, LightModel::direct, 1)
             .projected;
  }
  const SensorModel& sensor() const { return setup.rig.sensor; }

  Setup setup;
  Pattern pattern;
  Reference reference;
  Image<float> ir;
};

TEST(Match, AFrontoParallelPlaneIsMatchedToAHundredthOfAPixel) {
  for (const double height_mm : {600.0, 733.3, 1700.0}) {
    const Bench bench(height_mm);
    const Image<float> found = match(bench.sensor(), bench.ir, bench.reference);
    const double expected = disparity_of_depth(bench.sensor(), metres_from_mm(height_mm));
    double squares = 0.0, valid = 0.0, all = 0.0;
    for (int y = 20; y < bench.sensor().height - 20; ++y)
      for (int x = 80; x < bench.sensor().width - 80; ++x) {
        ++all;
        const double disparity = found(x, y);
        if (disparity <= 0.0) continue;
        ++valid;
        squares += (disparity - expected) * (disparity - expected);
      }
    EXPECT_GT(valid / all, 0.99) << height_mm;
    EXPECT_LT(std::sqrt(squares / valid), 0.01) << height_mm;  // the promised RMS [px]; one false match breaks it
  }
}

TEST(Match, DoesNotDependOnGainOrOffset) {
  const Bench bench(650.0);
  const Image<float> plain = match(bench.sensor(), bench.ir, bench.reference);
  Image<float> changed = bench.ir;
  for (float& value : changed.pixels()) value = 0.5f * value + 40.0f;
  const Image<float> other = match(bench.sensor(), changed, bench.reference);
  double squares = 0.0, both = 0.0, one = 0.0;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const float a = plain.pixels()[i], b = other.pixels()[i];
    one += (a > 0.0f) != (b > 0.0f);
    if (a <= 0.0f || b <= 0.0f) continue;
    ++both;
    squares += (a - b) * (a - b);
  }
  EXPECT_GT(both, 250000.0);
  EXPECT_LT(one / both, 1e-4);                 // thresholds met within rounding
  EXPECT_LT(std::sqrt(squares / both), 1e-3);  // rounding of float sums of 112 products, a tenth of the error itself
}

TEST(Match, ReachesADeskAtTheDevicesNearEnd) {
  for (const double height_mm : {450.0, 500.0, 600.0}) {
    const Bench bench(height_mm);
    const Image<float> found = match(bench.sensor(), bench.ir, bench.reference);
    const double expected = disparity_of_depth(bench.sensor(), metres_from_mm(height_mm));
    double right = 0.0;
    for (const float disparity : found.pixels()) right += std::fabs(disparity - expected) < 0.125;
    // All but two columns on each side, 1 − 4/640; one step of the device's law is 1/8 px.
    EXPECT_GT(right / static_cast<double>(found.size()), 0.993) << height_mm;
  }
}

TEST(Holes, AreFilledWithinOneSurfaceAndStayBetweenTwo) {
  constexpr float kHole = std::numeric_limits<float>::quiet_NaN();
  Image<float> disparity(12, 1);
  const float row[12] = {kHole, 1.0f, kHole, kHole, 1.75f, 2.0f, kHole, 9.0f, kHole, kHole, kHole, 9.0f};
  std::copy_n(row, 12, disparity.row(0));
  Image<float> kept = disparity;
  fill_holes(0, kept);
  EXPECT_TRUE(std::isnan(kept(2, 0)));
  fill_holes(2, disparity);
  EXPECT_TRUE(std::isnan(disparity(0, 0)));  // nothing on its left
  EXPECT_FLOAT_EQ(disparity(2, 0), 1.25f);
  EXPECT_FLOAT_EQ(disparity(3, 0), 1.5f);
  EXPECT_TRUE(std::isnan(disparity(6, 0)));  // between two surfaces
  EXPECT_TRUE(std::isnan(disparity(8, 0)));  // too wide
}

TEST(Match, ReachesAsNearAsTheSensorGivesDepths) {
  for (const char* model : {"xtion_pro_live", "xtion_pro_live_device", "kinect_v1", "kinect_v1_device"}) {
    const Json json = {{"model", model}, {"height_mm", 650}, {"pitch_deg", 90}};
    const SensorModel sensor = rig_from_json(JsonReader(json, "test")).sensor;
    const double nearest = disparity_of_depth(sensor, sensor.law.near) - disparity_of_depth(sensor, sensor.reference);
    EXPECT_LT(nearest, sensor.matcher.disparity_max_px - 1) << model;  // a peak needs a neighbour on both sides
    EXPECT_GT(nearest, sensor.matcher.disparity_max_px - 5) << model;
  }
}

TEST(Reference, OfTheSameSensorIsMadeOnce) {
  SensorModel sensor = Bench(650.0).sensor();
  const Pattern pattern(sensor.pattern, sensor.ir_scale());
  const auto first = reference_image(sensor, pattern, 1);
  EXPECT_EQ(reference_image(sensor, pattern, 1), first);
  sensor.unit.serial = 7;
  EXPECT_NE(reference_image(sensor, pattern, 1), first);
}

TEST(Reference, IsTheMeanOfThePatternOverEachPixel) {
  constexpr int kSamplesAcross = 2;
  constexpr double kBrightness = 500.0;  // of a dot's centre in focus
  for (const char* model : {"xtion_pro_live", "xtion_pro_live_device"}) {
    const Json json = {{"model", model}, {"height_mm", 650}, {"pitch_deg", 90}};
    SensorModel sensor = rig_from_json(JsonReader(json, "test")).sensor;
    sensor.unit = {};
    const Pattern pattern(sensor.pattern, sensor.ir_scale(), sensor.optics.projector_k1);
    const double scale = sensor.ir_scale(), blur = Defocus(sensor).blur_steps(sensor.reference);
    const Image<float> image = reference_image(sensor, pattern, 0, kSamplesAcross);
    for (int y = 301; y < 700; y += 57)
      for (int x = 301; x < 900; x += 7) {
        double mean = 0.0;
        for (const double dy : {0.25, 0.75})
          for (const double dx : {0.25, 0.75}) {
            const Eigen::Vector2d px((x + dx) / scale, (y - sensor.ir_first_row() + dy) / scale);
            Eigen::Vector2d seen = (px - sensor.principal_px) / sensor.focal_px;
            if (sensor.optics.distorts()) seen = sensor.optics.undistorted(seen);
            mean += 0.25 * pattern.intensity(pattern.on_grid(seen.x() - sensor.baseline / sensor.reference, seen.y(),
                                                             sensor.focal_px),
                                             blur);
          }
        // Both look up a Gaussian in steps; it changes by at most 1.4 of its height per step of the grid.
        ASSERT_NEAR(image(x, y) / kBrightness, mean, 4e-3) << model << ' ' << x << ' ' << y;
      }
  }
}

TEST(Match, WithoutContrastThereIsNoMatch) {
  const Bench bench(650.0);
  const Image<float> found = match(bench.sensor(), Image<float>(1280, 1024, 200.0f), bench.reference);
  for (const float disparity : found.pixels()) ASSERT_EQ(disparity, 0.0f);
}

}  // namespace
}  // namespace fathom
