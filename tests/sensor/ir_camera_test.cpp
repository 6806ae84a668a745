// Speckle and detector noise: their moments, and that they belong to (seed, frame, pixel).
#include "sim/sensor/ir_camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/render/scenes.h"

namespace fathom {
namespace {

struct Moments {
  double mean, variance;
};

Moments moments(std::span<const float> values) {
  const double n = static_cast<double>(values.size());
  double sum = 0.0, squares = 0.0;
  for (const float value : values) sum += value;
  for (const float value : values) squares += (value - sum / n) * (value - sum / n);
  return {sum / n, squares / n};
}

TEST(Speckle, GainsHaveUnitMeanAndTheGammasSpread) {
  const Pattern pattern(PatternModel{}, 2.0);
  NoiseModel noise;
  noise.speckle_shape = 4.54;
  const std::vector<float> gains = speckle_gains(noise, pattern, 1);
  ASSERT_EQ(gains.size(), static_cast<std::size_t>(pattern.columns()) * pattern.rows());
  const auto [mean, variance] = moments(gains);
  const double n = static_cast<double>(gains.size()), expected = 1.0 / 4.54;
  // 4 standard errors each: wrong once in 16000 seeds. The variance of a Gamma sample's variance is
  // σ⁴ (2 + 6 / shape) / n.
  EXPECT_NEAR(mean, 1.0, 4.0 * std::sqrt(expected / n));
  EXPECT_NEAR(variance, expected, 4.0 * expected * std::sqrt((2.0 + 6.0 / 4.54) / n));
  EXPECT_TRUE(speckle_gains(NoiseModel{}, pattern, 1).empty());
}

TEST(Exposure, ShotAndReadNoiseAdd) {
  NoiseModel noise;
  noise.electrons_per_dn = 10.0, noise.read_dn = 10.4;
  const Image<float> radiance(1000, 400, 300.0f);
  const Image<float> image = expose(radiance, noise, 3, 0);
  const auto [mean, variance] = moments(image.pixels());
  const double n = static_cast<double>(image.size()), expected = 300.0 / 10.0 + 10.4 * 10.4;
  // 4 standard errors each: wrong once in 16000 seeds.
  EXPECT_NEAR(mean, 300.0, 4.0 * std::sqrt(expected / n));
  EXPECT_NEAR(variance, expected, 4.0 * expected * std::sqrt(2.0 / n));
}

TEST(Exposure, GainMultipliesLightAndItsShotNoise) {
  NoiseModel noise;
  noise.electrons_per_dn = 10.0, noise.gain = 2.0, noise.offset_dn = -3.0;
  const Image<float> image = expose(Image<float>(1000, 400, 300.0f), noise, 3, 0);
  const auto [mean, variance] = moments(image.pixels());
  // 600 DN are 3000 electrons, of 0.2 DN each: 120 DN². 4 standard errors each: wrong once in 16000 seeds.
  const double n = static_cast<double>(image.size()), expected = 120.0;
  EXPECT_NEAR(mean, 597.0, 4.0 * std::sqrt(expected / n));
  EXPECT_NEAR(variance, expected, 4.0 * expected * std::sqrt(2.0 / n));
}

TEST(Ambient, LightsWhatIsSeenByItsAlbedo) {
  const LitScene scene(desk_setup(R"(, "noise": {"ambient_dn": 100})"));
  const Pattern pattern(scene.rig.sensor.pattern, scene.rig.sensor.ir_scale());
  const IrLight light = render_ir(scene.projector, scene.rig, pattern, 1, LightModel::direct, 1);
  EXPECT_FLOAT_EQ(light.ambient(640, 512), 55.0f);  // the desk's albedo is 0.55
}

TEST(Exposure, RoundsAndSaturatesAtItsBits) {
  NoiseModel noise;
  noise.bits = 10;
  Image<float> radiance(3, 1);
  radiance(0, 0) = 5000.0f, radiance(1, 0) = 12.4f;
  const Image<float> image = expose(radiance, noise, 1, 0);
  EXPECT_EQ(image(0, 0), 1023.0f);
  EXPECT_EQ(image(1, 0), 12.0f);
  EXPECT_EQ(image(2, 0), 0.0f);
}

TEST(Exposure, AnIdealCameraChangesNothing) {
  const Image<float> image = expose(Image<float>(3, 2, 17.25f), NoiseModel{}, 1, 0);
  for (const float value : image.pixels()) EXPECT_EQ(value, 17.25f);
}

TEST(Exposure, NoiseBelongsToSeedAndFrame) {
  NoiseModel noise;
  noise.read_dn = 5.0;
  const Image<float> radiance(100, 100, 50.0f);
  const auto pixels = [&](std::uint64_t seed, std::uint64_t frame) {
    const Image<float> image = expose(radiance, noise, seed, frame);
    return std::vector<float>(image.pixels().begin(), image.pixels().end());
  };
  const std::vector<float> first = pixels(1, 0);
  EXPECT_EQ(first, pixels(1, 0));
  EXPECT_NE(first, pixels(1, 1));
  EXPECT_NE(first, pixels(2, 0));
}

}  // namespace
}  // namespace fathom
