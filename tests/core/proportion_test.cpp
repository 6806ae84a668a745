// Intervals of proportions.
#include "core/proportion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fathom {
namespace proportion_test {

TEST(Proportion, ClopperAndPearsonsIntervalIsExact) {
  // No hits: the largest proportion of which none of ten is seen with 2.5 %.
  EXPECT_NEAR(clopper_pearson_95(0, 10).high, 1.0 - std::pow(0.025, 0.1), 1e-9);
  EXPECT_EQ(clopper_pearson_95(0, 10).low, 0.0);
  EXPECT_NEAR(clopper_pearson_95(10, 10).low, std::pow(0.025, 0.1), 1e-9);
  EXPECT_EQ(clopper_pearson_95(10, 10).high, 1.0);
  EXPECT_NEAR(clopper_pearson_95(5, 10).low, 0.187, 5e-4);  // tables
  EXPECT_NEAR(clopper_pearson_95(5, 10).high, 0.813, 5e-4);
}

TEST(Proportion, WilsonsIntervalIsWhereTheScoreIsTwoSigma) {
  for (const auto& [hits, trials] : {std::pair(0, 10), std::pair(3, 10), std::pair(40, 60)})
    for (const double end : {wilson_95(hits, trials).low, wilson_95(hits, trials).high}) {
      if (end == 0.0) continue;
      const double score = (hits - trials * end) / std::sqrt(trials * end * (1.0 - end));
      EXPECT_NEAR(std::abs(score), 1.959964, 1e-5) << hits << " of " << trials;
    }
  EXPECT_EQ(wilson_95(10, 10).high, 1.0);
}

TEST(Proportion, OfNoTrialsNothingIsKnown) {
  for (const Interval interval : {wilson_95(0, 0), clopper_pearson_95(0, 0)}) {
    EXPECT_EQ(interval.low, 0.0);
    EXPECT_EQ(interval.high, 1.0);
  }
}

}  // namespace proportion_test
}  // namespace fathom
