// Averaging the dots over a part of a walk's spread takes out chance and leaves the light.
#include "sim/sensor/blurred_pattern.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/render/light_walk.h"
#include "tests/render/scenes.h"

namespace fathom {
namespace {

TEST(BlurredPattern, KeepsADotsLightAndIsNeverWiderThanAsked) {
  Pattern pattern(PatternModel{}, 2.0);
  int column = pattern.columns() / 2;
  const int row = pattern.rows() / 2;
  while (!pattern.has_dot(column, row)) ++column;
  std::vector<float> gains(pattern.brightness().size());
  gains[static_cast<std::size_t>(row) * pattern.columns() + column] = 1.0f;  // the others are dark
  pattern.set_dot_gains(gains);
  const BlurredPattern blurred(pattern);
  const double dot_variance = pattern.sigma_steps() * pattern.sigma_steps();
  for (const double sigma_steps : {1.0, 2.0, 4.0, 8.0, 16.0}) {
    constexpr double kReach = 60.0;
    const double step = 0.25 * sigma_steps;
    double sum = 0.0, squares = 0.0;
    for (double y = -kReach; y <= kReach; y += step)
      for (double x = -kReach; x <= kReach; x += step) {
        const double value = blurred.intensity({column + x, row + y}, sigma_steps);
        sum += value, squares += value * 0.5 * (x * x + y * y);
      }
    // Linear interpolation keeps a sum up to its dependence on where the samples lie.
    EXPECT_NEAR(sum * step * step / (2.0 * std::numbers::pi * dot_variance), 1.0, 0.01) << sigma_steps;
    const double blur = std::sqrt(squares / sum - dot_variance);
    EXPECT_LE(blur, 1.02 * sigma_steps);
    EXPECT_GE(blur, 0.6 * sigma_steps);
  }
}

/// Light that walked to points all over a cup's inside: with the dots, and with their averages.
struct Walked {
  double mean = 0.0;                         ///< of all points
  double bias = 0.0;                         ///< root mean square over the points of what the averages change
  double noise = 0.0, averaged_noise = 0.0;  ///< standard deviations of one walk
};

Walked walk_in(const std::string& liquid) {
  const LitScene scene(cup_of(kPaperCup, fmt::format(R"(, "liquid": "{}", "fill_mm": 20)", liquid)));
  const Pattern pattern(scene.rig.sensor.pattern, scene.rig.sensor.ir_scale());
  const BlurredPattern blurred(pattern);
  constexpr int kAcross = 5, kPoints = kAcross * kAcross, kWalks = 4000;
  double sum = 0.0, squared_bias = 0.0, variance = 0.0, averaged_variance = 0.0;
  for (int i = 0; i < kPoints; ++i) {
    const Eigen::Vector3d at(0.008 * (i % kAcross - 2), 0.300 + 0.008 * (i / kAcross - 2), kPaperCupBottom);
    const auto seen = see(scene.world, scene.camera_ray(at));
    if (!seen) continue;
    double change[2] = {}, exact = 0.0, averaged = 0.0, exact_squares = 0.0, averaged_squares = 0.0;
    for (int walk = 0; walk < kWalks; ++walk) {
      Rng rng(1, i, walk);
      double by_dots = 0.0, by_average = 0.0;
      walk_light(scene.projector, *seen, rng, [&](const ReturnedLight& light) {
        by_dots += light.reflected * intensity_towards(pattern, scene.rig, light.direction);
        by_average += light.reflected * intensity_around(blurred, scene.rig, light);
      });
      change[walk % 2] += (by_average - by_dots) / (0.5 * kWalks);
      exact += by_dots / kWalks, exact_squares += by_dots * by_dots / kWalks;
      averaged += by_average / kWalks, averaged_squares += by_average * by_average / kWalks;
    }
    sum += averaged;
    squared_bias += change[0] * change[1];  // the halves share the bias, not the chance
    variance += exact_squares - exact * exact, averaged_variance += averaged_squares - averaged * averaged;
  }
  return {sum / kPoints, std::sqrt(std::max(squared_bias / kPoints, 0.0)), std::sqrt(variance / kPoints),
          std::sqrt(averaged_variance / kPoints)};
}

// 5 % of the mean is five standard errors of what chance leaves in the bias of these walks; the seed is fixed.
constexpr double kBias = 0.05;

TEST(BlurredPattern, LeavesLightThrownFromWallToWallWhereItIsAndTakesHalfTheChanceOut) {
  const Walked water = walk_in("water");
  EXPECT_LT(water.bias, kBias * water.mean);
  EXPECT_LT(water.averaged_noise, 0.5 * water.noise);
}

TEST(BlurredPattern, LeavesLightOutOfMilkTeaWhereItIs) {
  const Walked tea = walk_in("milk_tea");
  EXPECT_LT(tea.bias, kBias * tea.mean);
  EXPECT_LT(tea.averaged_noise, 0.9 * tea.noise);
}

}  // namespace
}  // namespace fathom
