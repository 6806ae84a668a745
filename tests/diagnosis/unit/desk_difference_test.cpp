// Sessions whose desks are read otherwise than those of the others.
#include "diagnosis/unit/desk_difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/rng.h"

namespace fathom {
namespace desk_difference_test {

using Field = std::function<double(const BiasCell&)>;

/// A whole image of desk with that error of disparity beside white noise.
BiasView view(int session, const Field& error_px) {
  constexpr double kNoise_px = 0.01;
  Rng rng(71, session);
  BiasView view;
  for (double row = 8.0; row < 480.0; row += kBiasCell_px)
    for (double column = 8.0; column < 640.0; column += kBiasCell_px) {
      const BiasCell cell{column, row, 20.0, kBiasCell_px * kBiasCell_px};
      view.cells.push_back(cell);
      view.errors_px.push_back(error_px(cell) + kNoise_px * rng.normal());
    }
  return view;
}

/// What every session of a unit shows.
double unit(const BiasCell& cell) { return 0.3 * std::sin(cell.column_px / 60.0) * std::cos(cell.row_px / 70.0); }

constexpr double kAlarm = 3e-4;  ///< p that chance makes once in 3,000 times

TEST(DeskDifference, AUnitsBiasAndAnotherPoseAreNone) {
  const auto tilted = [](const BiasCell& cell) {
    return unit(cell) + 0.4 + 0.5 * cell.column_px / 640.0 - 0.3 * cell.row_px / 480.0;
  };
  for (const DeskDifference& found : desk_differences({{0, view(0, unit)}, {1, view(1, tilted)}, {2, view(2, unit)}}))
    EXPECT_GT(found.p(), kAlarm) << "session " << found.session;
}

TEST(DeskDifference, ASmearOfOneSessionIsFoundWhereItIs) {
  constexpr double kSize_px = 0.25;
  const auto smeared = [](const BiasCell& cell) {
    const bool is_in = std::abs(cell.column_px - 480.0) < 48.0 && std::abs(cell.row_px - 128.0) < 48.0;
    return unit(cell) + (is_in ? kSize_px : 0.0);
  };
  const auto found = desk_differences({{0, view(0, unit)}, {1, view(1, smeared)}, {2, view(2, unit)}});
  ASSERT_EQ(found.size(), 3U);
  EXPECT_GT(found[1].bias_px, 0.0);
  EXPECT_LT(found[1].p(), kAlarm);
  EXPECT_NEAR(found[1].bias_px, kSize_px, 0.03);
  const Eigen::Vector2d middle = found[1].first_px + 0.5 * found[1].size_px;
  EXPECT_LT((middle - Eigen::Vector2d(480.0, 128.0)).norm(), 32.0);
  EXPECT_EQ(found[1].nearer_px, 20.0);
}

TEST(DeskDifference, BandsThatAreElsewhereInEachSessionAreFound) {
  const auto banded = [](double phase) {
    return [phase](const BiasCell& cell) { return unit(cell) + 0.08 * std::sin(cell.row_px / 30.0 + phase); };
  };
  const auto found = desk_differences({{0, view(0, banded(0.0))}, {1, view(1, banded(3.0))}});
  ASSERT_EQ(found.size(), 1U);  // of two sessions one is said to differ
  EXPECT_LT(found[0].p(), kAlarm);
}

TEST(DeskDifference, OneSessionHasNoOthers) { EXPECT_TRUE(desk_differences({{0, view(0, unit)}}).empty()); }

TEST(DeskDifference, WhatOnlyOneSessionShowsIsNotCompared) {
  BiasView left, right;
  for (const auto& [side, keeps_left] : {std::pair(&left, true), std::pair(&right, false)}) {
    const BiasView all = view(0, unit);
    for (std::size_t i = 0; i < all.cells.size(); ++i)
      if ((all.cells[i].column_px < 320.0) == keeps_left) {
        side->cells.push_back(all.cells[i]);
        side->errors_px.push_back(all.errors_px[i]);
      }
  }
  EXPECT_TRUE(desk_differences({{0, left}, {1, right}}).empty());
}

}  // namespace desk_difference_test
}  // namespace fathom
