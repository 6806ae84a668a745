// What many placements together show of the shape of what is seen in a cup.
#include "diagnosis/predict/content_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/rng.h"

namespace fathom {
namespace {

constexpr double kRadius_m = 0.03;
constexpr int kBumpAt = 18;  // 12 mm right, 12 mm far
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// Of a flat bottom with a bump of 2 mm, in cups that each stand a little higher or lower, all of whose errors are
/// drawn anew by `draw`.
std::vector<ContentSight> sights(int count, double noise_mm, double bump_mm = 2.0, int cells = 10,
                                 std::uint64_t draw = 0) {
  std::vector<ContentSight> result;
  for (int i = 0; i < count; ++i) {
    Rng rng(7 + draw, static_cast<std::uint64_t>(i));
    ContentSight sight;
    sight.condition = static_cast<std::size_t>(i);
    sight.factors.liquid = "water";
    sight.measured.fill(kNothing);
    sight.predicted.fill(kNothing);
    const double lift_mm = 3.0 * rng.normal();
    for (int cell = 10; cell < 10 + cells; ++cell) {
      sight.predicted[cell] = 5.0;
      sight.measured[cell] = 5.0 + lift_mm + noise_mm * rng.normal() + (cell == kBumpAt ? bump_mm : 0.0);
      sight.cells.set(cell);
    }
    result.push_back(sight);
  }
  return result;
}

TEST(ContentShape, ShowsABumpThatPoursAndPlacesHide) {
  const std::vector<ContentShape> shapes = content_shapes(sights(12, 0.2), kRadius_m);
  ASSERT_EQ(shapes.size(), 10u);
  for (const ContentShape& shape : shapes) {
    const Observation& o = shape.observation;
    EXPECT_EQ(o.repeats, 12);
    EXPECT_NEAR(o.repeat_sd, 0.20, 0.1);  // 3 σ of a scatter of twelve
    EXPECT_NEAR(o.value, shape.cell == kBumpAt ? 1.8 : -0.2, 4.0 * 0.2 / std::sqrt(12.0));
  }
  EXPECT_EQ(shapes[8].observation.factors.region, "12 mm right of and 12 mm beyond the middle");
  EXPECT_EQ(shapes[2].observation.factors.region, "middle");
}

// Differences from a mean are not independent: of n cells they say as much as n − 1 observations, also of two or three.
TEST(ContentShape, SaysNoMoreThanItsCells) {
  constexpr int kDraws = 1000, kPlacements = 12;
  for (const int cells : {2, 3, 6}) {
    double sum = 0.0;
    for (int draw = 0; draw < kDraws; ++draw)
      for (const ContentShape& shape : content_shapes(sights(kPlacements, 0.2, 0.0, cells, draw + 1), kRadius_m))
        sum += kPlacements * std::pow(shape.observation.value / shape.observation.repeat_sd, 2.0);
    const double expected = (cells - 1) * 11.0 / 9.0;  // of squares of Student's t of 11 degrees of freedom
    EXPECT_NEAR(sum / kDraws, expected, 0.16 * expected) << cells << " cells";  // 3 σ or more
  }
}

TEST(ContentShape, NeedsThreePlacements) {
  EXPECT_TRUE(content_shapes(sights(2, 0.2), kRadius_m).empty());
  EXPECT_FALSE(content_shapes(sights(3, 0.2), kRadius_m).empty());
}

TEST(ContentShape, IsPredictedFromTheSameCells) {
  const std::vector<ContentShape> shapes = content_shapes(sights(4, 0.0), kRadius_m);
  const ContentShape& bump = shapes[8];
  CellHeights heights;
  heights.fill(kNothing);
  for (int cell = 10; cell < 20; ++cell) heights[cell] = 9.0 + (cell == kBumpAt ? 1.0 : 0.0);
  EXPECT_NEAR(bump.predicted([&](std::size_t) { return &heights; }), 0.9, 1e-12);
  // Conditions that are not looked at count as 0, so that differences over some of them are right.
  EXPECT_NEAR(bump.predicted([&](std::size_t i) { return i == 0 ? &heights : nullptr; }), 0.9 / 4.0, 1e-12);
  // A cell that the model no longer sees goes up with the others: the rest of the shape stays.
  heights[11] = kNothing;
  EXPECT_NEAR(bump.predicted([&](std::size_t) { return &heights; }), 1.0 - (1.0 + 1.0 / 9.0) / 10.0, 1e-12);
}

}  // namespace
}  // namespace fathom
