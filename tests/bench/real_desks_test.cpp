// Desks that a Kinect measured: what the model of the sensor lacks is named, and closes the gap.
#include <gtest/gtest.h>

#include <algorithm>

#include "bench/real_desks.h"
#include "core/json.h"
#include "diagnosis/decision/diagnosis_json.h"

namespace fathom {
namespace {

struct RealDesks : testing::TestWithParam<std::string> {};

/// The slow bias that this unit's memorised image has left is smooth and lens-like: a distortion explains it as well.
bool is_name_of(const std::string& effect, const std::string& known) {
  return effect == known || (known == "reference_residue" && effect == "radial_distortion");
}

TEST_P(RealDesks, NameWhatTheModelLacks) {
  const auto found = diagnose_desks(GetParam());
  if (!found) GTEST_SKIP() << "no measured clouds: FATHOM_REAL_DATA names no folder with mOSD in it";
  const auto is_it = [](const NamedEffect& e) { return is_name_of(e.name, GetParam()); };
  const auto holds_it = [](const std::vector<std::string>& effects) {
    return std::count(effects.begin(), effects.end(), GetParam()) > 0;
  };
  const auto leaves_it_open = [&](const Explanation& e) {
    return holds_it(e.effects) || std::any_of(e.alternatives.begin(), e.alternatives.end(), holds_it) ||
           std::any_of(e.supersets.begin(), e.supersets.end(), holds_it);
  };
  const Diagnosis& diagnosis = found->diagnosis;
  EXPECT_TRUE(std::any_of(diagnosis.effects.begin(), diagnosis.effects.end(), is_it))
      << json_from(diagnosis)["ambiguity_set"].dump();
  EXPECT_TRUE(std::any_of(diagnosis.ambiguity_set.begin(), diagnosis.ambiguity_set.end(), leaves_it_open))
      << json_from(diagnosis)["ambiguity_set"].dump();
  EXPECT_LT(found->after, 1.0);  // in errors: the gap is closed
  EXPECT_GT(found->before, 2.0);
}

INSTANTIATE_TEST_SUITE_P(Known, RealDesks, testing::ValuesIn(known_of_desks()),
                         [](const auto& desk) { return desk.param; });

}  // namespace
}  // namespace fathom
