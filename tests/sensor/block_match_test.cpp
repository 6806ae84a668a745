// The device's matching: steps of 1/8 px, a border of half a block, and nothing that allows for slopes.
#include "sim/sensor/block_match.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/sensor/capture.h"
#include "sim/sensor/depth.h"
#include "tests/render/scenes.h"

namespace fathom {
namespace {

/// A level desk `height_mm` below a sensor that looks straight down.
Setup facing_desk(double height_mm, const std::string& more) {
  return setup_from_json(Json::parse(fmt::format(R"({{"sensor": {{"model": "xtion_pro_live_device", "height_mm": {},
      "pitch_deg": 90{}}}, "desk": {{"size_mm": [4000, 4000]}}}})",
                                                 height_mm, more)),
                         "test");
}
constexpr const char* kIdeal = R"(, "noise": "off", "quantization": "off", "unit": {"residue_px": 0})";

TEST(BlockMatch, MeasuresAFacingPlaneToTheNearestEighth) {
  for (const double height_mm : {700.0, 1700.0}) {
    const auto setup = facing_desk(height_mm, kIdeal);
    Camera camera(setup, CaptureMode::photometric, 4, 1);
    const Frame frame = camera.shoot(0);
    const double truth = disparity_of_depth(setup.rig.sensor, metres_from_mm(height_mm));
    const double at_reference = disparity_of_depth(setup.rig.sensor, setup.rig.sensor.reference);
    int right = 0, valid = 0;
    for (const float disparity : frame.disparity_px.pixels()) {
      if (disparity == 0.0f) continue;
      ++valid;
      const double steps = 8.0 * (disparity - at_reference);
      ASSERT_NEAR(steps, std::round(steps), 1e-3);
      // Half a step, and half a step for dots as wide as the pixels that sample them, and out of focus beside the
      // reference's.
      right += std::fabs(disparity - truth) < 1.0 / 8.0;
    }
    // All but a border of half a block to the left and to the right.
    EXPECT_EQ(valid, (640 - 8) * 480);
    EXPECT_GT(right, 0.99 * valid) << height_mm;
  }
}

/// Deviation of the disparities of a desk pitched by 35 degrees [steps of 1/8 px], from their median absolute error:
/// here and there a block is matched elsewhere.
double slope_noise(const std::string& more) {
  const auto setup = setup_from_json(
      Json::parse(
          R"({"sensor": {"model": "xtion_pro_live_device", "height_mm": 600, "pitch_deg": 35, "quantization": "off",
      "unit": {"residue_px": 0}, )" +
          more + R"(}, "desk": {"size_mm": [4000, 4000]}})"),
      "test");
  Camera camera(setup, CaptureMode::photometric, 4, 1);
  const Frame frame = camera.shoot(0);
  std::vector<double> errors;
  for (int y = 200; y < 400; ++y)
    for (int x = 100; x < 540; ++x) {
      const auto& apparent = camera.truth()(x, y).apparent_depth;
      if (!apparent || frame.disparity_px(x, y) == 0.0f) continue;
      errors.push_back(8.0 * std::abs(frame.disparity_px(x, y) - disparity_of_depth(setup.rig.sensor, *apparent)));
    }
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  return 1.4826 * *middle;
}

TEST(BlockMatch, SlopesGetNoiseThatTheDotsDraw) {
  // 0.1 px of disparity per row times a lot of about 0.7 rows is half a step: much more than on a facing plane.
  const double sigma = slope_noise(R"("noise": "off")");
  EXPECT_GT(sigma, std::sqrt(1.0 / 12.0) + 0.05);  // the steps themselves
  EXPECT_LT(sigma, 0.7);                           // what desks show with speckle
}

TEST(BlockMatch, SlopesGetLessNoiseWhereBrightDotsCountForLess) {
  // Fully developed speckle gives dots a contrast of one; in the root of light a half.
  const double in_light = slope_noise(R"("matcher": {"compression_dn": 0})"),
               in_root = slope_noise(R"("matcher": {"compression_dn": 100})");
  EXPECT_LT(in_root, 0.9 * in_light);
  EXPECT_GT(in_root, 0.6 * in_light);  // the lot of which rows the dots stand in stays
}

TEST(BlockMatch, OfTheDeviceMeasuresAMatteDeskAlmostEverywhere) {
  Camera camera(facing_desk(900.0, ""), CaptureMode::photometric, 4, 1);
  const Frame frame = camera.shoot(0);
  double valid = 0.0;
  for (const float depth : frame.depth.pixels()) valid += depth > 0.0f;
  EXPECT_GE(valid / (632.0 * 480.0), 0.99);  // promised, inside the border
}

TEST(BlockMatch, EvenLightThatDrownsTheDotsLeavesNoDepth) {
  const auto valid = [](const char* ambient_dn) {
    const auto setup = facing_desk(
        900.0,
        fmt::format(R"(, "noise": {{"ambient_dn": {}}}, "matcher": {{"relative_contrast_min": 0.2}})", ambient_dn));
    const Frame frame = Camera(setup, CaptureMode::photometric, 4, 1).shoot(0);
    double count = 0.0;
    for (const float depth : frame.depth.pixels()) count += depth > 0.0f;
    return count / (632.0 * 480.0);
  };
  // Dots on albedo 0.55 at 0.9 m deviate by some 100 DN from their mean; ambient light adds 0.55 of its number.
  EXPECT_GT(valid("10"), 0.99);
  EXPECT_LT(valid("5000"), 0.01);
}

}  // namespace
}  // namespace fathom
