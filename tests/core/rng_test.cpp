#include "core/rng.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace fathom {
namespace {

// The seeds are fixed, so a passing test stays passing. With a fresh seed each z-test below would fail a right sampler
// once in 16 000 times (4 standard errors, two-sided).
constexpr double kLimit = 4.0;
constexpr int kDraws = 200'000;

struct Moments {
  double mean = 0.0, variance = 0.0, fourth = 0.0;  ///< central
};

template <class Draw>
Moments moments(Draw draw) {
  std::vector<double> values(kDraws);
  Moments result;
  for (double& value : values) result.mean += (value = draw()) / kDraws;
  for (const double value : values) {
    const double square = (value - result.mean) * (value - result.mean);
    result.variance += square / kDraws;
    result.fourth += square * square / kDraws;
  }
  return result;
}

void expect_mean_and_variance(const Moments& found, double mean, double variance) {
  EXPECT_LT(std::abs(found.mean - mean) / std::sqrt(variance / kDraws), kLimit);
  const double sigma_of_variance = std::sqrt((found.fourth - found.variance * found.variance) / kDraws);
  EXPECT_LT(std::abs(found.variance - variance) / sigma_of_variance, kLimit);
}

TEST(Rng, SameKeysGiveTheSameStream) {
  Rng a(1, 2, 3), b(1, 2, 3);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a.bits(), b.bits());
}

TEST(Rng, EveryKeyAndItsPlaceMatter) {
  std::set<std::uint64_t> first;
  for (int seed = 0; seed < 10; ++seed)
    for (int frame = 0; frame < 10; ++frame)
      for (int pixel = 0; pixel < 10; ++pixel) first.insert(Rng(seed, frame, pixel).bits());
  for (int seed = 0; seed < 10; ++seed) first.insert(Rng(seed).bits());
  EXPECT_EQ(first.size(), 1010u);  // a chance collision of 64 bits: 3e-14
}

TEST(Rng, NeighbouringKeysAreUncorrelated) {
  double sum = 0.0;
  for (int pixel = 0; pixel < kDraws; ++pixel)
    sum += (Rng(5, pixel).uniform() - 0.5) * (Rng(5, pixel + 1).uniform() - 0.5);
  EXPECT_LT(std::abs(sum / kDraws) / (1.0 / 12.0 / std::sqrt(kDraws)), kLimit);
}

TEST(Rng, UniformHasItsMomentsAndRange) {
  Rng rng(11);
  double low = 1.0, high = 0.0;
  const Moments found = moments([&] {
    const double u = rng.uniform();
    low = std::min(low, u), high = std::max(high, u);
    return u;
  });
  expect_mean_and_variance(found, 0.5, 1.0 / 12.0);
  EXPECT_GE(low, 0.0);
  EXPECT_LT(high, 1.0);
}

TEST(Rng, UniformFillsItsBinsEvenly) {
  constexpr int kBins = 100;
  Rng rng(12);
  std::vector<int> counts(kBins);
  for (int i = 0; i < kDraws; ++i) ++counts[static_cast<std::size_t>(rng.uniform() * kBins)];
  const double expected = static_cast<double>(kDraws) / kBins;
  double chi2 = 0.0;
  for (const int count : counts) chi2 += (count - expected) * (count - expected) / expected;
  // chi² of 99 degrees of freedom exceeds 161 once in 10 000 times.
  EXPECT_LT(chi2, 161.0);
}

TEST(Rng, BelowReachesEveryValueEvenly) {
  Rng rng(13);
  const Moments found = moments([&] { return static_cast<double>(rng.below(7)); });
  expect_mean_and_variance(found, 3.0, 4.0);  // of 0 … 6
}

TEST(Rng, NormalHasItsMoments) {
  Rng rng(14);
  const Moments found = moments([&] { return rng.normal(); });
  expect_mean_and_variance(found, 0.0, 1.0);
  EXPECT_LT(std::abs(found.fourth - 3.0) / std::sqrt(96.0 / kDraws), kLimit);  // the 4th power has variance 105 - 9
}

TEST(Rng, GammaHasItsMoments) {
  for (const double shape : {1.0, 2.5, 40.0}) {
    Rng rng(15, static_cast<std::uint64_t>(shape * 2.0));
    const Moments found = moments([&] { return rng.gamma(shape, 0.5); });
    expect_mean_and_variance(found, shape * 0.5, shape * 0.25);
  }
}

}  // namespace
}  // namespace fathom
