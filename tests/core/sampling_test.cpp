// Monte Carlo until it is good enough.
#include "core/sampling.h"

#include <gtest/gtest.h>

#include "core/rng.h"

namespace fathom {
namespace {

std::uint64_t two_coins(std::uint64_t sample, std::span<double> heads) {
  Rng rng(3, sample);
  heads[0] = rng.uniform() < 0.3 ? 1.0 : 0.0;
  heads[1] = rng.uniform() < 0.01 ? 1.0 : 0.0;
  return 1;
}

TEST(Sampling, GoesOnUntilTheWorstErrorIsReached) {
  const SamplingResult result = sample_until({.relative_error = 0.01}, 2, two_coins);
  EXPECT_TRUE(result.reached);
  // The rarer coin needs (1 − p) / p / 0.01² samples; it stops when its own estimate says so, known to about 1 %.
  EXPECT_NEAR(static_cast<double>(result.samples), 0.99 / 0.01 * 1e4, 0.1 * 0.99e6);
  EXPECT_LE(result.quantities[1].standard_error, 0.01 * result.quantities[1].value);
  // 4 standard errors: once in 16 000 times with a fresh seed.
  EXPECT_LT(std::fabs(result.quantities[0].value - 0.3), 4.0 * result.quantities[0].standard_error);
  EXPECT_LT(std::fabs(result.quantities[1].value - 0.01), 4.0 * result.quantities[1].standard_error);
}

TEST(Sampling, ErrorsAreThoseOfIndependentSamples) {
  const SamplingResult result = sample_until({.samples = 10'000}, 2, two_coins);
  EXPECT_EQ(result.samples, 10'000u);
  const double p = result.quantities[0].value;
  EXPECT_NEAR(result.quantities[0].standard_error, std::sqrt(p * (1.0 - p) / 9999.0), 1e-12);  // roundings
}

TEST(Sampling, OnlyJudgedQuantitiesAreWaitedFor) {
  EXPECT_LT(sample_until({.judged = 1, .relative_error = 0.01}, 2, two_coins).samples, 100'000u);
}

TEST(Sampling, GivesUpWhenTheWorkIsDone) {
  const SamplingResult result = sample_until({.relative_error = 1e-6, .most_work = 50'000}, 2, two_coins);
  EXPECT_FALSE(result.reached);
  EXPECT_LT(result.samples, 100'000u);
}

TEST(Sampling, NothingSeenIsKnownToOneInTheSamples) {
  const auto nothing = [](std::uint64_t, std::span<double>) -> std::uint64_t { return 1; };
  const SamplingResult result = sample_until({.absolute_error = 1e-5}, 1, nothing);
  EXPECT_TRUE(result.reached);
  EXPECT_GE(result.samples, 100'000u);
}

TEST(Mean, PartsMakeTheWhole) {
  Rng rng(4);
  Mean whole, first, second;
  for (int i = 0; i < 1000; ++i) {
    const double value = 5.0 + rng.normal();
    whole.add(value);
    (i < 300 ? first : second).add(value);
  }
  first.add(second);
  EXPECT_EQ(first.count(), whole.count());
  EXPECT_NEAR(first.estimate().value, whole.estimate().value, 1e-13);  // a thousand roundings of 5
  EXPECT_NEAR(first.estimate().standard_error, whole.estimate().standard_error, 1e-14);
}

}  // namespace
}  // namespace fathom
