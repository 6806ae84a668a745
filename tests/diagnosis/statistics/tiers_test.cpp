// What only names raises no alarm; what differs by more than is stated does.
#include "diagnosis/decision/tiers.h"
#include "core/json.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "diagnosis/decision/decide.h"
#include "diagnosis/decision/diagnosis_json.h"
#include "diagnosis/statistics/groups.h"
#include "tests/diagnosis/statistics/small_campaign.h"

namespace fathom {
namespace {

/// The campaign's infrared brightness, off by so much everywhere, helps to name and no more.
Evidence with_odd_brightness(const World& world, bool only_names, std::uint64_t seed) {
  Evidence evidence = world.measure({}, {}, seed);
  for (Observation& o : evidence.observations) {
    const bool is_deciding = o.observable.ends_with("_mm") || o.observable.ends_with("_deg");
    if (is_deciding) continue;
    o.value += (o.factors.distance_mm < 300.0 ? 1.0 : -1.0) * (o.factors.fill_mm < 20.0 ? 1.0 : -0.5);
    o.only_names = only_names;
  }
  return evidence;
}

TEST(Tiers, WhatOnlyNamesRaisesNoAlarmAndIsListed) {
  const World world(small_design());
  const Diagnosis as_gap = decide(with_odd_brightness(world, false, 3), world.predict());
  ASSERT_NE(as_gap.verdict, Verdict::none);  // it is a gap where it decides
  const Diagnosis diagnosis = decide(with_odd_brightness(world, true, 3), world.predict());
  EXPECT_EQ(diagnosis.verdict, Verdict::none);
  EXPECT_FALSE(diagnosis.departures.beside.empty());
  EXPECT_EQ(diagnosis.residuals.before.size(), world.nominal().observations.size());
}

TEST(Tiers, WhatOnlyNamesDoesNotHideWhatHeightsShow) {
  const World world(small_design());
  Evidence evidence = world.measure({world.at_strength("subsurface_scattering", 20.0, 1.0)}, {}, 5);
  const Evidence odd = with_odd_brightness(world, true, 5), plain = world.measure({}, {}, 5);
  for (std::size_t i = 0; i < evidence.observations.size(); ++i) {
    evidence.observations[i].only_names = odd.observations[i].only_names;
    evidence.observations[i].value += odd.observations[i].value - plain.observations[i].value;
  }
  const Diagnosis diagnosis = decide(evidence, world.predict());
  EXPECT_NE(diagnosis.verdict, Verdict::none);
  EXPECT_TRUE(std::any_of(diagnosis.ambiguity_set.begin(), diagnosis.ambiguity_set.end(), [](const Explanation& e) {
    return std::find(e.effects.begin(), e.effects.end(), "subsurface_scattering") != e.effects.end();
  }));
}

/// So many pours of each filling in each of two sessions.
World poured_in_sessions(int pours) {
  CampaignDesign design = small_design();
  design.pours = 2 * pours;
  return World(design);
}

Evidence with_session_off(const World& world, double by_mm, double stated_mm, std::uint64_t seed) {
  Evidence evidence = world.measure({}, {}, seed);
  evidence.stated.session_mm = stated_mm;
  for (Observation& o : evidence.observations)
    if (o.observable == "height_mm" && o.factors.session == 1) o.value += by_mm;
  return evidence;
}

TEST(Excess, ASessionThatReadsHigherIsAFindingWithItsSize) {
  const World world = poured_in_sessions(2);
  const Diagnosis diagnosis = decide(with_session_off(world, 1.9, 0.1, 4), world.predict());
  EXPECT_TRUE(diagnosis.verdict == Verdict::unknown || diagnosis.verdict == Verdict::named_and_unknown)
      << json_from(diagnosis).dump();
  ASSERT_FALSE(diagnosis.departures.excess.empty());
  const Excess& excess = diagnosis.departures.excess.front();
  EXPECT_EQ(excess.level, "session");
  EXPECT_EQ(excess.group, "1");
  EXPECT_EQ(excess.observable, "height_mm");
  EXPECT_NEAR(excess.size, 1.9, 4.0 * excess.sigma);
  EXPECT_GT(excess.size, 5.0 * excess.sigma);
  // The probabilities say what the verdict says.
  EXPECT_GT(diagnosis.probability_of_unknown, 0.9);
  EXPECT_EQ(diagnosis.ambiguity_set.front().effects, std::vector<std::string>{"unknown"});
  EXPECT_NEAR(diagnosis.ambiguity_set.front().probability, diagnosis.probability_of_unknown, 0.05);
}

/// What is stated of sessions is known better than two sessions could tell: with one pour of each filling in each, they
/// are told from the scatter of pours.
TEST(Excess, OnePourASessionIsEnough) {
  const World world = poured_in_sessions(1);
  const Diagnosis diagnosis = decide(with_session_off(world, 1.9, 0.1, 4), world.predict());
  EXPECT_EQ(diagnosis.verdict, Verdict::unknown) << json_from(diagnosis).dump();
  ASSERT_FALSE(diagnosis.departures.excess.empty());
  EXPECT_NEAR(diagnosis.departures.excess.front().size, 1.9, 4.0 * diagnosis.departures.excess.front().sigma);
}

TEST(Excess, ASessionThatMayDifferAsMuchIsNone) {
  const World world = poured_in_sessions(2);
  EXPECT_TRUE(decide(with_session_off(world, 1.9, 3.0, 4), world.predict()).departures.excess.empty());
}

/// Every pour of the liquid is off by so much, up and down in turn.
TEST(Excess, PoursThatScatterMoreThanIsStatedAreAFinding) {
  const World world = poured_in_sessions(2);
  for (const double stated_mm : {0.5, 4.0}) {
    Evidence evidence = world.measure({}, {}, 4);
    evidence.stated.fill_mm = stated_mm;
    for (Observation& o : evidence.observations)
      if (o.observable == "height_mm" && o.factors.liquid != "empty" && o.factors.liquid != "none")
        o.value += (o.factors.pour + static_cast<int>(o.factors.fill_mm / 10.0)) % 2 ? 2.0 : -2.0;
    const Diagnosis diagnosis = decide(evidence, world.predict());
    const bool is_finding = std::any_of(diagnosis.departures.excess.begin(), diagnosis.departures.excess.end(),
                                        [](const Excess& excess) { return excess.level == "pour"; });
    EXPECT_EQ(is_finding, stated_mm < 1.0) << json_from(diagnosis)["excess"].dump();
    if (is_finding) {
      EXPECT_NE(diagnosis.verdict, Verdict::none);
    }
  }
}

TEST(Excess, SessionsThatAreAlikeRaiseNoAlarm) {
  const World world = poured_in_sessions(2);
  int alarms = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    alarms += decide(with_session_off(world, 0.0, 0.1, seed), world.predict()).verdict != Verdict::none;
  // At a rate of 1 %, two or more of 20 come once in 60 times.
  EXPECT_LE(alarms, 1);
}

/// Who puts cups down to a twentieth of a millimetre still has a matcher that sees other dots each time.
TEST(Excess, AJigDoesNotMakeTheSensorExact) {
  CampaignDesign design = small_design();
  design.placements = 3;
  const World world(design);
  const auto alarms = [&](bool sees_other_dots) {
    int count = 0;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      Evidence evidence = world.measure({}, {}, seed);  // placements differ by 0.12 mm
      evidence.stated.placement_mm = 0.05;
      std::vector<int> conditions = group_by(evidence.observations, [](const Observation& o) {
                                      return o.observable == "height_mm" ? condition_key(o) : std::string();
                                    }).of;
      evidence.shared_errors.push_back({.observable = "height_mm",
                                        .group_of = std::move(conditions),
                                        .sigma = 0.15,
                                        .is_by_condition = sees_other_dots});
      count += !decide(evidence, world.predict()).departures.excess.empty();
    }
    return count;
  };
  EXPECT_EQ(alarms(true), 0);  // at a rate of 0.03 %, any of five comes once in 700 times
  EXPECT_GT(alarms(false), 0);
}

/// One liquid in each session, and an effect of one of them that has an exact alias: it is no session that differs.
TEST(Excess, WhatAnExplanationMakesOfSessionsIsNone) {
  const World world = poured_in_sessions(2);
  Evidence evidence = world.measure({world.at_strength("subsurface_scattering", 30.0, 1.0)}, {}, 5);
  evidence.stated.session_mm = 0.1;
  const int scattering = world.candidate("subsurface_scattering");
  evidence.candidates.push_back(evidence.candidates[scattering]);
  evidence.candidates.back().effect = "alias";
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < evidence.observations.size(); ++i) {
    const Factors& f = evidence.observations[i].factors;
    if (f.liquid == (f.session == 0 ? "water" : "milk_tea")) rows.push_back(static_cast<Eigen::Index>(i));
  }
  const Predict predict = [&](std::vector<EffectValue> values) {
    for (EffectValue& value : values)
      if (value.effect == "alias") value.effect = "subsurface_scattering";
    return world.predict()(values);
  };
  const Diagnosis diagnosis = decide(evidence_of_rows(evidence, rows), predict_rows(predict, rows));
  EXPECT_EQ(diagnosis.verdict, Verdict::ambiguous) << json_from(diagnosis).dump();
  EXPECT_TRUE(diagnosis.departures.excess.empty()) << json_from(diagnosis)["excess"].dump();
}

}  // namespace
}  // namespace fathom
