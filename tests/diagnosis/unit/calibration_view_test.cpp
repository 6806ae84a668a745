// Desks in clouds: what stands on them is none of them, and a bias is not cut off.
#include "diagnosis/unit/calibration_view.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/rng.h"
#include "diagnosis/unit/depth_facts.h"
#include "diagnosis/unit/pixel_noise.h"
#include "diagnosis/unit/warm_up.h"

namespace fathom {
namespace desk_view_test {

constexpr DeviceScale kExact{.focal_px = 570.342, .baseline_m = 0.075, .camera_m = 0.0, .cut_m = 0.0};
constexpr int kWidth = 640, kHeight = 480;

Plane desk() { return plane_from({.height_m = 0.65, .pitch_rad = 1.0}); }

/// Every pixel's point; `disparity_px` makes of a pixel and its true disparity what is read there.
template <class Read>
Points cloud(Read disparity_px) {
  const Plane plane = desk();
  Points points;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const Eigen::Vector3d ray((x + 0.5 - 320.0) / kExact.focal_px, (y + 0.5 - 240.0) / kExact.focal_px, 1.0);
      const double z = -plane.offset / plane.normal.dot(ray);
      const double read = disparity_px(x, y, kExact.focal_px * kExact.baseline_m / z);
      points.push_back((ray * kExact.focal_px * kExact.baseline_m / read).cast<float>());
    }
  return points;
}

double bias_px(double x, double y) { return 0.38 * std::sin(x / 90.0) * std::cos(y / 80.0); }

TEST(DeskView, ASmoothBiasIsNotCutOff) {
  Rng rng(1, 2, 3);
  const Points points =
      cloud([&](int x, int y, double disparity) { return disparity + bias_px(x, y) + 0.1 * rng.normal(); });
  const auto seen = desk_view({&points, 1}, desk(), kExact);
  ASSERT_TRUE(seen);
  ASSERT_GT(seen->view.cells.size(), 1150u);
  // What the fitted plane takes of the bias is a plane; second differences have none.
  double worst = 0.0;
  const auto& cells = seen->view.cells;
  for (std::size_t i = 1; i + 1 < cells.size(); ++i) {
    if (cells[i - 1].row_px != cells[i + 1].row_px || cells[i + 1].column_px - cells[i - 1].column_px > 33.0) continue;
    const auto at = [&](std::size_t cell) { return bias_px(cells[cell].column_px, cells[cell].row_px); };
    const auto& errors = seen->view.errors_px;
    worst = std::max(worst,
                     std::abs(errors[i - 1] - 2.0 * errors[i] + errors[i + 1] - at(i - 1) + 2.0 * at(i) - at(i + 1)));
  }
  EXPECT_LT(worst, 0.06);  // noise of 256 pixels, and the bias within a cell
}

TEST(DeskView, WhatStandsOnADeskIsNoneOfIt) {
  const auto is_box = [](int x, int y) { return x >= 300 && x < 400 && y >= 200 && y < 300; };
  const Points points = cloud([&](int x, int y, double disparity) { return disparity + (is_box(x, y) ? 4.0 : 0.0); });
  const auto seen = desk_view({&points, 1}, desk(), kExact);
  ASSERT_TRUE(seen);
  for (std::size_t i = 0; i < seen->view.cells.size(); ++i) {
    const BiasCell& cell = seen->view.cells[i];
    EXPECT_FALSE(is_box(static_cast<int>(cell.column_px), static_cast<int>(cell.row_px)));
    EXPECT_NEAR(seen->view.errors_px[i], 0.0, 0.01);
    EXPECT_NEAR(cell.nearer_px, seen->view.cells.front().nearer_px, 40.0);
  }
  EXPECT_NEAR(seen->plane.offset, desk().offset, 1e-4);
}

TEST(DeskView, AThinnedCloudHasTheSameBias) {
  const Points whole = cloud([](int x, int y, double disparity) { return disparity + bias_px(x, y); });
  Points thin;
  for (std::size_t i = 0; i < whole.size(); ++i)
    if (i % kWidth % 3 == 0 && i / kWidth % 3 == 0) thin.push_back(whole[i]);
  const auto all = desk_view({&whole, 1}, desk(), kExact), some = desk_view({&thin, 1}, desk(), kExact);
  ASSERT_TRUE(all && some);
  ASSERT_EQ(all->view.cells.size(), some->view.cells.size());
  for (std::size_t i = 0; i < all->view.cells.size(); ++i)
    EXPECT_NEAR(all->view.errors_px[i], some->view.errors_px[i], 0.02);
}

TEST(DeskView, CoordinatesBeyondAnyIntegerLieBesideTheImage) {
  Points points = cloud([](int, int, double disparity) { return disparity; });
  const auto without = desk_view({&points, 1}, desk(), kExact);
  for (const float far : {1e30f, -1e30f}) points.emplace_back(far, far, 0.7f);
  const auto with = desk_view({&points, 1}, desk(), kExact);
  ASSERT_TRUE(with && without);
  EXPECT_EQ(with->view.errors_px, without->view.errors_px);
}

TEST(DepthFacts, TheLawIsReadOffTheDepths) {
  struct Law {
    double focal_px, phase, cut_mm;
    int together;
  };
  for (const Law& law : {Law{570.342, 0.5, 1.0, 1},
                         {575.816, 0.5, 1.0, 1},
                         {570.342, 0.0, 1.0, 1},
                         {570.342, 0.5, 0.1, 1},
                         {570.342, 0.53, 1.0, 1},
                         {575.816, 0.23, 0.1, 1},
                         {570.342, 0.71, 0.0, 1},
                         {575.816, 0.5, 1.0, 2}}) {
    const Points points = cloud([&](int, int, double disparity) {
      const double steps_mm = 8.0 * law.focal_px * 75.0, true_mm = kExact.focal_px * 75.0 / disparity;
      double code = std::round(steps_mm * (1.0 / 1200.0 - 1.0 / true_mm) - law.phase);
      code = law.together * std::floor(code / law.together);
      const double mm = 1.0 / (1.0 / 1200.0 - (code + law.phase) / steps_mm);
      return kExact.focal_px * 75.0 / (law.cut_mm > 0.0 ? law.cut_mm * std::floor(mm / law.cut_mm) : mm);
    });
    const DepthFacts facts = depth_facts({&points, 1}, std::array{570.342, 575.816}, 0.075);
    EXPECT_EQ(facts.focal_px, law.focal_px);
    EXPECT_NEAR(facts.phase, law.phase, 0.005);
    EXPECT_EQ(facts.cut_mm, law.cut_mm);
    EXPECT_EQ(facts.step_px, 0.125 * law.together);
    EXPECT_GT(facts.on_law, 0.98);
  }
  const Points smooth = cloud([](int, int, double disparity) { return disparity; });
  const DepthFacts none = depth_facts({&smooth, 1}, std::array{570.342}, 0.075);
  EXPECT_EQ(none.step_px, 0.0);
  EXPECT_EQ(none.cut_mm, 0.0);
}

TEST(PixelNoise, HasTheSizeAndTheCorrelationThatWereMade) {
  Rng rng(4, 5, 6);
  std::vector<double> white((kWidth + 4) * kHeight);
  for (double& value : white) value = rng.normal();
  // Means of four neighbours: 0.75, 0.5 and 0 of the variance at 1, 2 and 4 px.
  const Points points = cloud([&](int x, int y, double disparity) {
    double sum = 0.0;
    for (int k = 0; k < 4; ++k) sum += white[y * (kWidth + 4) + x + k];
    return disparity + 0.1 * 0.5 * sum;
  });
  NoiseSums sums;
  sums.add(points, kWidth, desk(), kExact);
  const PixelNoise noise = sums.noise();
  EXPECT_NEAR(noise.sigma_px, 0.1, 0.002);
  EXPECT_NEAR(noise.along_rows[0], 0.75, 0.02);
  EXPECT_NEAR(noise.along_rows[1], 0.5, 0.02);
  EXPECT_NEAR(noise.along_rows[2], 0.0, 0.03);
  EXPECT_NEAR(noise.along_columns[0], 0.0, 0.02);
}

TEST(WarmUp, ComesBackWithItsTime) {
  Rng rng(7, 8, 9);
  std::vector<TimedDisparity> readings;
  for (int i = 0; i < 40; ++i)
    readings.push_back({90.0 * i, 30.0 + 0.4 * std::exp(-90.0 * i / 900.0) + 0.01 * rng.normal()});
  const auto warm_up = warm_up_of(readings);
  ASSERT_TRUE(warm_up);
  EXPECT_NEAR(warm_up->warm_up_px, 0.4, 4.0 * warm_up->sigma_px);
  EXPECT_LT(warm_up->sigma_px, 0.02);
  EXPECT_NEAR(warm_up->warm_up_s, 900.0, 200.0);
  EXPECT_FALSE(warm_up_of(std::span(readings).first(4)));
}

/// `count` readings a minute apart, the first at `from_s`, of a device that has `amplitude_px` too much when cold.
std::vector<TimedDisparity> readings_of(std::uint64_t seed, double amplitude_px, double from_s, int count) {
  Rng rng(seed, 8, 9);
  std::vector<TimedDisparity> readings;
  for (int i = 0; i < count; ++i) {
    const double time_s = from_s + 60.0 * i;
    readings.push_back({time_s, 30.0 + amplitude_px * std::exp(-time_s / 300.0) + 0.01 * rng.normal()});
  }
  return readings;
}

TEST(WarmUp, SigmaCountsThatTheTimeIsNotKnown) {
  constexpr int kTimes = 400;
  double squares = 0.0;
  int found = 0;
  for (std::uint64_t seed = 1; seed <= kTimes; ++seed)
    if (const auto warm_up = warm_up_of(readings_of(seed, 0.5, 120.0, 20))) {
      squares += std::pow((warm_up->warm_up_px - 0.5) / warm_up->sigma_px, 2.0);
      ++found;
    }
  EXPECT_EQ(found, kTimes);
  EXPECT_LT(std::sqrt(squares / found), 1.2);
  EXPECT_GT(std::sqrt(squares / found), 0.85);
}

TEST(WarmUp, ADeviceThatDoesNotWarmUpHasNone) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) found += warm_up_of(readings_of(seed, 0.0, 0.0, 30)).has_value();
  EXPECT_LE(found, 3);
}

TEST(WarmUp, ARecordingThatBeginsWhenTheDeviceIsWarmSaysNothingOfACold) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) found += warm_up_of(readings_of(seed, 0.5, 2400.0, 20)).has_value();
  EXPECT_LE(found, 1);
}

}  // namespace desk_view_test
}  // namespace fathom
