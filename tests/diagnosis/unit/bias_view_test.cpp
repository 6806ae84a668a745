// How views of one scene scatter, measured where they bend.
#include "diagnosis/unit/bias_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "core/rng.h"

namespace fathom {
namespace bias_view_test {

constexpr int kScenes = 40, kViews = 4;

/// A clouds' part of the image, each cell with an error.
BiasView view_of(const std::function<double(double column_px, double row_px)>& error_px) {
  BiasView view;
  for (double row = 168.0; row < 440.0; row += kBiasCell_px)
    for (double column = 136.0; column < 480.0; column += kBiasCell_px) {
      view.cells.push_back({column, row, 20.0, kBiasCell_px * kBiasCell_px});
      view.errors_px.push_back(error_px(column, row));
    }
  return view;
}

/// Of scenes whose views have errors drawn anew beside what they share.
std::optional<double> cell_px(const std::function<BiasView(Rng&)>& draw) {
  ViewScatter scatter;
  for (std::uint64_t scene = 0; scene < kScenes; ++scene) {
    std::vector<BiasView> views;
    for (std::uint64_t view = 0; view < kViews; ++view) {
      Rng rng(scene, 17, view);
      views.push_back(draw(rng));
    }
    scatter.add(views);
  }
  return scatter.cell_px();
}

TEST(ViewScatter, OfIndependentCellsIsTheirError) {
  const std::optional<double> found = cell_px([](Rng& rng) {
    return view_of([&](double column, double row) {
      const double shared = 0.2 * std::sin(column / 50.0) * std::cos(row / 60.0), plane = 0.1 * column / 320.0;
      return shared + plane + 0.03 * rng.normal();
    });
  });
  ASSERT_TRUE(found);
  // 360 degrees of freedom: 4 % of it; three times that allowed.
  EXPECT_NEAR(*found, 0.03, 0.12 * 0.03);
}

TEST(ViewScatter, OfSmoothErrorsIsThatOfCellsThatBendViewsAsMuch) {
  // Of a wave across 700 px the clouds see half: it bends them about as (column / 344 px)² does.
  const auto draw = [](double amplitude) {
    return [amplitude](Rng& rng) {
      const double phase = 2.0 * std::numbers::pi * rng.uniform();
      return view_of([&](double column, double) {
        return amplitude * std::cos(2.0 * std::numbers::pi * column / 700.0 + phase) + 0.001 * rng.normal();
      });
    };
  };
  const std::optional<double> small = cell_px(draw(0.02)), large = cell_px(draw(0.04));
  ASSERT_TRUE(small && large);
  EXPECT_GT(*small, 0.02) << "more than any cell is off";
  EXPECT_NEAR(*large, 2.0 * *small, 0.01 * *large);
}

TEST(ViewScatter, OfSingleViewsIsNotKnown) {
  ViewScatter scatter;
  scatter.add(std::vector{view_of([](double, double) { return 0.1; })});
  EXPECT_FALSE(scatter.cell_px());
}

}  // namespace bias_view_test
}  // namespace fathom
