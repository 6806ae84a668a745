// Desks that a Kinect measured: what the model of the sensor lacks is among the explanations of the gap.
#include <gtest/gtest.h>

#include <algorithm>

#include "bench/real_desks.h"

namespace fathom {
namespace {

bool is_in_set(const Diagnosis& diagnosis, const std::string& effect) {
  const auto holds = [&](const std::vector<std::string>& names) {
    return std::find(names.begin(), names.end(), effect) != names.end();
  };
  return std::any_of(diagnosis.ambiguity_set.begin(), diagnosis.ambiguity_set.end(), [&](const Explanation& one) {
    return holds(one.effects) || std::any_of(one.alternatives.begin(), one.alternatives.end(), holds);
  });
}

struct RealDesks : testing::TestWithParam<std::string> {};

TEST_P(RealDesks, AreExplainedByWhatTheModelLacks) {
  const auto found = diagnose_desks(GetParam());
  if (!found) GTEST_SKIP() << "no measured clouds: FATHOM_REAL_DATA names no folder with mOSD in it";
  EXPECT_NE(found->diagnosis.verdict, Verdict::none);
  EXPECT_TRUE(is_in_set(found->diagnosis, GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Known, RealDesks,
                         testing::Values("depth_quantization", "depth_step_phase", "noise_correlation"),
                         [](const auto& desk) { return desk.param; });

}  // namespace
}  // namespace fathom
