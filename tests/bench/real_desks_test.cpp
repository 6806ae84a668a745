// Desks that a Kinect measured: what the model of the sensor lacks is named, and closes the gap.
#include <gtest/gtest.h>

#include <algorithm>

#include "bench/real_desks.h"

namespace fathom {
namespace {

struct RealDesks : testing::TestWithParam<std::string> {};

TEST_P(RealDesks, NameWhatTheModelLacks) {
  const auto found = diagnose_desks(GetParam());
  if (!found) GTEST_SKIP() << "no measured clouds: FATHOM_REAL_DATA names no folder with mOSD in it";
  const std::vector<NamedEffect>& effects = found->diagnosis.effects;
  EXPECT_TRUE(std::any_of(effects.begin(), effects.end(), [](const NamedEffect& e) { return e.name == GetParam(); }));
  EXPECT_LT(found->after, 1.0);  // in errors: the gap is closed
  EXPECT_GT(found->before, 2.0);
}

INSTANTIATE_TEST_SUITE_P(Known, RealDesks, testing::ValuesIn(known_of_desks()),
                         [](const auto& desk) { return desk.param; });

}  // namespace
}  // namespace fathom
