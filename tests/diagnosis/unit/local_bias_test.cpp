// A smear on the lens is told from the bias that every unit has.
#include "diagnosis/unit/local_bias.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/rng.h"

namespace fathom {
namespace local_bias_test {

constexpr double kAlarm = 3e-4;  // p that chance makes once in 3,000 times

/// A whole image of desk: waves of 0.1 px in all that are smooth over 70 px, a lean, white errors, and a smear.
BiasView desk(std::uint64_t seed, double smear_px, double smear_reach_px = 30.0) {
  constexpr int kWaves = 64;
  constexpr double kBias_px = 0.1, kReach_px = 70.0, kNoise_px = 0.02;
  Rng rng(seed, 12);
  std::vector<Eigen::Vector3d> waves;
  for (int i = 0; i < kWaves; ++i)
    waves.emplace_back(rng.normal() / kReach_px, rng.normal() / kReach_px, 2.0 * std::numbers::pi * rng.uniform());
  BiasView view;
  for (double row = 8.0; row < 480.0; row += kBiasCell_px)
    for (double column = 8.0; column < 640.0; column += kBiasCell_px) {
      double error = 0.3 * column / 640.0 + kNoise_px * rng.normal();
      for (const Eigen::Vector3d& wave : waves)
        error += kBias_px * std::sqrt(2.0 / kWaves) * std::cos(wave.x() * column + wave.y() * row + wave.z());
      const double distance_px = std::hypot(column - 300.0, row - 200.0);
      error += smear_px * std::exp(-0.5 * std::pow(distance_px / smear_reach_px, 2.0));
      view.cells.push_back({column, row, 25.0, kBiasCell_px * kBiasCell_px});
      view.errors_px.push_back(error);
    }
  return view;
}

std::optional<LocalBias> found_in(const BiasView& view) {
  const BiasLearner learner({&view, 1}, bias_prior_of(view, default_bias_prior()));
  return most_local_bias(learner, {&view, 1});
}

TEST(LocalBias, AUnitsOwnBiasIsNone) {
  double least = 1.0;
  for (std::uint64_t unit = 1; unit <= 20; ++unit) {
    const auto found = found_in(desk(unit, 0.0));
    ASSERT_TRUE(found);
    least = std::min(least, found->p());
  }
  EXPECT_GT(least, kAlarm);
}

TEST(LocalBias, ASmearIsFoundWhereItIs) {
  for (const double size_px : {0.3, -0.3}) {
    const auto found = found_in(desk(5, size_px));
    ASSERT_TRUE(found);
    EXPECT_LT(found->p(), kAlarm);
    EXPECT_NEAR(found->bias_px, size_px, 0.1);
    EXPECT_LT((found->middle_px - Eigen::Vector2d(300.0, 200.0)).norm(), 20.0);
    EXPECT_EQ(found->nearer_px, 25.0);
  }
}

TEST(LocalBias, OfTooLittleDeskNothingIsSaid) {
  BiasView view = desk(1, 0.3);
  view.cells.resize(60), view.errors_px.resize(60);
  EXPECT_FALSE(most_local_bias(BiasLearner({&view, 1}, default_bias_prior()), {&view, 1}));
}

/// Clouds may be cut out around the cup. The plane that is fitted to each leans with the bias there.
TEST(LocalBias, PartsWhosePlanesLeanOtherwiseAreNone) {
  for (std::uint64_t unit = 1; unit <= 10; ++unit) {
    const BiasView whole = desk(unit, 0.0);
    std::vector<BiasView> parts(3);
    for (std::size_t part = 0; part < parts.size(); ++part)
      for (std::size_t i = 0; i < whole.cells.size(); ++i) {
        const double beside = std::abs(whole.cells[i].column_px - 200.0 - 120.0 * static_cast<double>(part));
        if (beside > 130.0 || std::abs(whole.cells[i].row_px - 240.0) > 130.0) continue;
        parts[part].cells.push_back(whole.cells[i]);
        parts[part].errors_px.push_back(whole.errors_px[i] + 0.2 * static_cast<double>(part));
      }
    const auto found = most_local_bias(BiasLearner(parts, bias_prior_of(whole, default_bias_prior())), parts);
    ASSERT_TRUE(found);
    EXPECT_GT(found->p(), kAlarm) << unit;
  }
}

}  // namespace local_bias_test
}  // namespace fathom
