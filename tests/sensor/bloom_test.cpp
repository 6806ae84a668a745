// Charge that spills over: nothing is lost, and only saturated pixels spill.
#include "sim/sensor/bloom.h"

#include <gtest/gtest.h>

#include <numeric>

namespace fathom {
namespace {

double sum_of(const Image<float>& image) { return std::accumulate(image.pixels().begin(), image.pixels().end(), 0.0); }

TEST(Bloom, KeepsTheChargeAndSpreadsItEvenlyToAllSides) {
  Image<float> image(201, 201, 10.0f);
  image(100, 100) = 50'000.0f;
  const double before = sum_of(image);
  bloom(1023.0, 0.8, 4.0, image);
  EXPECT_NEAR(sum_of(image) / before, 1.0, 1e-5);  // float sums; exp(-100 / 4.5) of it reaches an edge
  EXPECT_GT(image(104, 100), 100.0f);
  EXPECT_NEAR(image(104, 100) / image(96, 100), 1.0, 1e-4);
  EXPECT_NEAR(image(104, 100) / image(100, 104), 1.0, 1e-4);
  // Mean distance along an axis of what was spilled: Σ |x| decay^|x| norm = 2 decay / (1 − decay²), with decay 0.8.
  double distance = 0.0, spilled = 0.0;
  for (int y = 0; y < 201; ++y)
    for (int x = 0; x < 201; ++x) {
      const double value = x == 100 && y == 100 ? 0.0 : image(x, y) - 10.0;
      distance += value * std::abs(x - 100), spilled += value;
    }
  EXPECT_NEAR(distance / (0.8 * (50'000.0 - 1023.0)), 2.0 * 0.8 / (1.0 - 0.64), 0.01);
}

TEST(Bloom, NothingSpillsBelowSaturation) {
  Image<float> image(20, 20, 1023.0f);
  bloom(1023.0, 1.0, 4.0, image);
  for (const float value : image.pixels()) EXPECT_EQ(value, 1023.0f);
}

}  // namespace
}  // namespace fathom
