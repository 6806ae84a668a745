// The projected pattern has the published drawing's statistics, and every window of it is its own.
#include "sim/sensor/pattern.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/core/expect_error.h"

namespace fathom {
namespace {

class DotTile : public testing::Test {
 protected:
  static void SetUpTestSuite() { tile_ = make_dot_tile(PatternModel{}); }

  /// The repeated tile.
  static bool dot(int x, int y) {
    return tile_((x + tile_.width()) % tile_.width(), (y + tile_.height()) % tile_.height()) != 0;
  }

  template <class Visit>
  static void for_dots(Visit visit) {
    for (int y = 0; y < tile_.height(); ++y)
      for (int x = 0; x < tile_.width(); ++x)
        if (dot(x, y)) visit(x, y);
  }

  inline static Image<std::uint8_t> tile_;
};

TEST_F(DotTile, HoldsTheDrawingsNumberOfDots) {
  int dots = 0;
  for_dots([&](int, int) { ++dots; });
  EXPECT_EQ(dots, 3861);
  EXPECT_NEAR(dots / static_cast<double>(tile_.size()), 0.111, 5e-4);  // half a unit of the published digit
}

TEST_F(DotTile, NoTwoDotsTouchSeamsIncluded) {
  for_dots([&](int x, int y) {
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        if (dx == 0 && dy == 0) continue;
        ASSERT_FALSE(dot(x + dx, y + dy)) << x << ' ' << y;
      }
  });
}

TEST_F(DotTile, NearestNeighboursLieWhereTheDrawingsDo) {
  std::map<int, double> share;  // by squared distance
  for_dots([&](int x, int y) {
    int nearest = 1000;
    for (int dy = -6; dy <= 6; ++dy)
      for (int dx = -6; dx <= 6; ++dx)
        if ((dx || dy) && dot(x + dx, y + dy)) nearest = std::min(nearest, dx * dx + dy * dy);
    share[nearest] += 1.0 / 3861;
  });
  // Published 37, 46, 8 and 6 %. Another drawing by the same law would differ by two or three standard deviations of a
  // binomial of 3861 (0.8 %), and the law itself is not published: within 5 %.
  EXPECT_NEAR(share[4], 0.37, 0.05);
  EXPECT_NEAR(share[5], 0.46, 0.05);
  EXPECT_NEAR(share[8], 0.08, 0.05);
  EXPECT_NEAR(share[9], 0.06, 0.05);
}

TEST_F(DotTile, WindowsHoldFourToFourteenDots) {
  int least = 81, most = 0;
  double sum = 0.0;
  for (int y = 0; y < tile_.height(); ++y)
    for (int x = 0; x < tile_.width(); ++x) {
      int count = 0;
      for (int cell = 0; cell < 81; ++cell) count += dot(x + cell % 9, y + cell / 9);
      least = std::min(least, count), most = std::max(most, count), sum += count;
    }
  EXPECT_GE(least, 4);
  EXPECT_LE(most, 14);
  EXPECT_NEAR(sum / static_cast<double>(tile_.size()), 9.0, 0.02);  // 81 · 3861 / (211 · 165) = 8.98
}

TEST_F(DotTile, WindowsDifferByFiveCellsAlongTheirRow) { EXPECT_GE(least_window_difference(tile_, 9, 136), 5); }

TEST_F(DotTile, IsPointSymmetric) {
  for_dots([&](int x, int y) { ASSERT_TRUE(dot(tile_.width() - 1 - x, tile_.height() - 1 - y)); });
}

TEST_F(DotTile, TheSeedIsTheTile) {
  const auto same = [](const Image<std::uint8_t>& a, const Image<std::uint8_t>& b) {
    return std::equal(a.pixels().begin(), a.pixels().end(), b.pixels().begin());
  };
  PatternModel model;
  EXPECT_TRUE(same(make_dot_tile(model), tile_));
  model.seed = 2;
  EXPECT_FALSE(same(make_dot_tile(model), tile_));
}

TEST(Pattern, TooManyDotsAreRefused) {
  PatternModel crowded;
  crowded.dots_per_tile = 211 * 165 / 4;
  expect_error([&] { make_dot_tile(crowded); }, {"pattern: dots_per_tile: leaves no room"});
}

TEST(Pattern, ADotIsAGaussianAndTheGridsMeanIsItsMean) {
  const PatternModel model;
  const Pattern pattern(model, 2.0);
  const double focal_px = 570.0, sigma_px = 0.5 * model.dot_sigma_ir_px;
  const int row = pattern.rows() / 2;
  int column = 5;
  while (!pattern.has_dot(column, row)) ++column;
  const double x = (column - 0.5 * (pattern.columns() - 1)) / focal_px;
  const double y = (row - 0.5 * (pattern.rows() - 1)) / focal_px;
  const auto intensity = [&](double at_x, double at_y) {
    return pattern.intensity(pattern.on_grid(at_x, at_y, focal_px));
  };
  // The nearest other dots stand 2 positions away: at most 8 tails of exp(−½ (2 / 0.45)²) = 5e-5.
  EXPECT_NEAR(intensity(x, y), 1.0, 5e-4);
  // One σ towards such a neighbour its tail is exp(−½ (1.55 / 0.45)²) = 0.003.
  EXPECT_NEAR(intensity(x, y + sigma_px / focal_px), std::exp(-0.5), 0.01);
  EXPECT_EQ(intensity(2.0, 0.0), 0.0);  // outside the grid

  double sum = 0.0;
  constexpr int kSamples = 400;
  for (int j = 0; j < kSamples; ++j)  // one tile's worth, evenly
    for (int i = 0; i < kSamples; ++i)
      sum += intensity((i + 0.5) / kSamples * 211 / focal_px, (j + 0.5) / kSamples * 165 / focal_px);
  // Samples half a step apart see a Gaussian of 0.45 steps almost exactly; the table's steps cost 1e-3.
  EXPECT_NEAR(sum / (kSamples * kSamples) / pattern.mean_intensity(), 1.0, 0.005);
}

TEST(Pattern, DotsOutOfFocusSpreadTheSameLight) {
  const Pattern pattern(PatternModel{}, 2.0);
  const auto mean = [&](double blur) {
    double sum = 0.0;
    constexpr int kSamples = 200;
    for (int j = 0; j < kSamples; ++j)
      for (int i = 0; i < kSamples; ++i)
        sum += pattern.intensity({211.0 + (i + 0.5) / kSamples * 211.0, 165.0 + (j + 0.5) / kSamples * 165.0}, blur);
    return sum / (kSamples * kSamples);
  };
  // The grid of samples is a step wide; 0.5 % covers what it misses of sharp dots.
  EXPECT_NEAR(mean(0.6) / mean(0.0), 1.0, 0.005);
  EXPECT_LT(pattern.intensity({105.0, 82.0}, 0.6), pattern.intensity({105.0, 82.0}));  // the middle of a tile is a dot
}

TEST(Pattern, TilesHaveASpotInTheirMiddleAndTheirOwnBrightness) {
  PatternModel model;
  model.zero_order = 5.0, model.tile_spread = 0.2;
  const Pattern pattern(model, 2.0);
  const auto brightness = [&](int column, int row) { return pattern.brightness()(column, row); };
  int column = 0;
  while (!pattern.has_dot(column, 0)) ++column;
  EXPECT_FLOAT_EQ(brightness(105, 82), 5.0f * brightness(column, 0));
  EXPECT_NE(brightness(105, 82), brightness(105 + 211, 82));
}

TEST(Pattern, MayBeAUsersImage) {
  PatternModel model;
  Image<float> own(40, 30);
  own(20, 15) = 1.0f, own(10, 15) = 0.25f;
  model.image.brightness = std::make_shared<const Image<float>>(own);
  const Pattern pattern(model, 2.0);
  EXPECT_EQ(pattern.columns(), 40);
  EXPECT_NEAR(pattern.intensity({20.0, 15.0}), 1.0, 1e-6);
  EXPECT_NEAR(pattern.intensity({10.0, 15.0}), 0.25, 1e-6);
  EXPECT_NEAR(pattern.intensity({15.0, 15.0}), 0.0, 1e-6);
}

}  // namespace
}  // namespace fathom
