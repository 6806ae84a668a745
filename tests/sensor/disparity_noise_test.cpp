// The statistical noise of geometric captures: its moments, its correlations, what it shares between frames.
#include "sim/sensor/disparity_noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/sensor/capture.h"
#include "sim/sensor/depth.h"
#include "tests/render/scenes.h"

namespace fathom {
namespace {

double covariance(const Image<float>& a, const Image<float>& b, int dx = 0, int dy = 0) {
  double sum = 0.0;
  for (int y = 0; y + dy < a.height(); ++y)
    for (int x = 0; x + dx < a.width(); ++x) sum += a(x, y) * b(x + dx, y + dy);
  return sum / (static_cast<double>(a.width() - dx) * (a.height() - dy));
}

// 640 × 480 pixels in blocks of 81 are some 3800 independent ones: variances are known to 2.3 %, covariances to 1.6 %;
// the bounds are three of these deviations.
constexpr double kOfVariance = 0.07, kOfCovariance = 0.05;

TEST(BlockChance, NeighboursShareWhatTheirBlocksShare) {
  const BlockChance chance = block_chance(SensorModel{}, 1, 0);
  for (const Image<float>* image : {&chance.level, &chance.across, &chance.down})
    EXPECT_NEAR(covariance(*image, *image), 1.0, kOfVariance);
  for (const int lag : {1, 2, 4, 8})
    EXPECT_NEAR(covariance(chance.level, chance.level, lag), 1.0 - lag / 9.0, kOfCovariance);
  // Σ i (i + lag) over what two windows of 9 share, over Σ i² = 60.
  EXPECT_NEAR(covariance(chance.down, chance.down, 0, 1), 40.0 / 60.0, kOfCovariance);
  EXPECT_NEAR(covariance(chance.down, chance.down, 0, 4), -10.0 / 60.0, kOfCovariance);
  EXPECT_NEAR(covariance(chance.level, chance.down), 0.0, kOfCovariance);
  EXPECT_NEAR(covariance(chance.level, chance.level, 9), 0.0, kOfCovariance);
}

Setup noisy_wall(double height_mm, const char* noise) {
  return setup_from_json(Json::parse(fmt::format(R"({{"sensor": {{"model": "xtion_pro_live", "height_mm": {},
      "pitch_deg": 90, "quantization": "off", "noise": {{"disparity": {}}}}}, "desk": {{"size_mm": [4000, 4000]}}}})",
                                                 height_mm, noise)),
                         "test");
}

/// Disparities of the middle of an image less their true value.
Image<float> errors(const Setup& setup, const Frame& frame) {
  constexpr int kBorder = 20;
  const auto exact = static_cast<float>(disparity_of_depth(setup.rig.sensor, setup.rig.camera_in_world().z()));
  Image<float> middle(frame.disparity_px.width() - 2 * kBorder, frame.disparity_px.height() - 2 * kBorder);
  for (int y = 0; y < middle.height(); ++y)
    for (int x = 0; x < middle.width(); ++x) middle(x, y) = frame.disparity_px(x + kBorder, y + kBorder) - exact;
  return middle;
}

TEST(GeometricNoise, HasTheDeviationAskedForAndRenewsItsShare) {
  const auto setup = noisy_wall(1000, R"({"facing_px": 0.05, "renewed": 0.25})");
  Camera camera(setup, CaptureMode::geometric, 1, 1);
  const Frame first = camera.shoot(0), second = camera.shoot(1);
  const Image<float> a = errors(setup, first), b = errors(setup, second);
  EXPECT_NEAR(covariance(a, a) / (0.05 * 0.05), 1.0, kOfVariance);
  EXPECT_NEAR(covariance(a, b) / (0.05 * 0.05), 0.75, kOfVariance);
  // The same frame again, by another camera: the same bytes.
  const Frame again = Camera(setup, CaptureMode::geometric, 1, 1).shoot(0);
  for (std::size_t i = 0; i < again.disparity_px.size(); ++i)
    ASSERT_EQ(again.disparity_px.pixels()[i], first.disparity_px.pixels()[i]);
}

TEST(GeometricNoise, OnASlopeIsTheSlopeTimesWhereTheLightLies) {
  const auto setup =
      setup_from_json(Json::parse(R"({"sensor": {"model": "xtion_pro_live", "height_mm": 600, "pitch_deg": 40,
      "quantization": "off", "noise": {"disparity": {"lateral_px": 0.5}}}, "desk": {"size_mm": [9000, 9000]}})"),
                      "test");
  const Frame frame = Camera(setup, CaptureMode::geometric, 1, 1).shoot(0);
  const Frame exact = [&] {
    auto still = setup;
    still.rig.sensor.noise.disparity = {};
    return Camera(still, CaptureMode::geometric, 1, 1).shoot(0);
  }();
  double squares = 0.0, count = 0.0;
  for (int y = 200; y < 470; ++y)
    for (int x = 30; x < 610; ++x)
      squares += std::pow(frame.disparity_px(x, y) - exact.disparity_px(x, y), 2.0), ++count;
  // A plane's disparity rises by b cos(pitch) / h for each row.
  const double slope = 0.075 * std::cos(radians_from_deg(40.0)) / 0.600;
  EXPECT_NEAR(std::sqrt(squares / count) / (0.5 * slope), 1.0, kOfVariance);
}

TEST(GeometricNoise, LeavesHolesWhereDotsAreTooFaint) {
  SensorModel sensor;
  sensor.noise.disparity.facing_px = 0.05;
  const double depth = 1.0, least = sensor.matcher.contrast_min / block_contrast(sensor, 1.0, depth);
  Image<float> exact(sensor.width, sensor.height, static_cast<float>(disparity_of_depth(sensor, depth)));
  Image<float> intensity(sensor.width, sensor.height, static_cast<float>(1.01 * least));
  for (int y = 0; y < 100; ++y) std::fill_n(intensity.row(y), sensor.width, static_cast<float>(0.99 * least));
  const Image<float> noisy =
      disparity_with_noise(sensor, exact, intensity, block_chance(sensor, 1, 0), block_chance(sensor, 1, 1));
  for (int y = 0; y < sensor.height; ++y) EXPECT_EQ(noisy(320, y) > 0.0f, y >= 100) << y;
  EXPECT_EQ(noisy(3, 200), 0.0f);  // less than half a block from the side
  EXPECT_GT(noisy(4, 200), 0.0f);
}

TEST(ReferenceResidue, HasTheDeviationAndTheReachAskedForAndIsTheUnitsOwn) {
  UnitModel unit;
  unit.residue_px = 0.1, unit.residue_reach_px = 10.0;
  const Image<float> field = reference_residue(unit, 0, 2000, 2000);
  // 2000² / (4 π 10²) = 3183 independent places and 64 waves: 2.5 % and 12 % of the variance from a field's own waves.
  EXPECT_NEAR(covariance(field, field) / 0.01, 1.0, 0.1);
  EXPECT_NEAR(covariance(field, field, 10) / covariance(field, field), std::exp(-0.5), 0.15);
  unit.serial = 1;
  EXPECT_NEAR(covariance(field, reference_residue(unit, 0, 2000, 2000)) / 0.01, 0.0, 0.1);
  EXPECT_TRUE(reference_residue(UnitModel{}, 0, 8, 8).empty());
}

TEST(ReferenceResidue, MovesWhatTheMatcherFinds) {
  const auto wall = [](CaptureMode mode) {
    const auto setup =
        setup_from_json(Json::parse(R"({"sensor": {"model": "xtion_pro_live", "height_mm": 1200, "pitch_deg": 90,
        "quantization": "off", "noise": "off", "unit": {"residue_px": 0.2, "residue_reach_px": 80}}, "desk": {"size_mm": [4000, 4000]}})"),
                        "test");
    return Camera(setup, mode, 4, 1).shoot(0).disparity_px;
  };
  const Image<float> matched = wall(CaptureMode::photometric), added = wall(CaptureMode::geometric);
  for (int y = 40; y < 440; y += 20)
    for (int x = 40; x < 600; x += 20) EXPECT_NEAR(matched(x, y), added(x, y), 0.02) << x << ' ' << y;
}

}  // namespace
}  // namespace fathom
