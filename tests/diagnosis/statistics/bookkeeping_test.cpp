// Mistakes of the laboratory that observations and predictions show, and what to measure next.
#include <gtest/gtest.h>

#include <algorithm>

#include "diagnosis/decision/hygiene.h"
#include "diagnosis/decision/next_measurement.h"
#include "diagnosis/statistics/groups.h"
#include "diagnosis/statistics/problem.h"
#include "diagnosis/statistics/screen.h"
#include "tests/diagnosis/statistics/small_campaign.h"

namespace fathom {
namespace {

std::vector<std::string> warnings(const Evidence& evidence) { return hygiene_warnings(evidence); }

TEST(Hygiene, IsQuietAboutACleanCampaign) {
  const World world(small_design());
  EXPECT_TRUE(warnings(world.measure({}, {}, 1)).empty());
}

TEST(Hygiene, SeesHeightsInAnotherUnit) {
  const World world(small_design());
  Evidence evidence = world.measure({}, {}, 1);
  for (Observation& o : evidence.observations)
    if (is_height(o)) o.value /= 1000.0;
  const auto found = warnings(evidence);
  EXPECT_TRUE(std::any_of(found.begin(), found.end(),
                          [](const std::string& w) { return w.find("unit") != std::string::npos; }));
}

TEST(Hygiene, SeesExchangedLabels) {
  const World world(small_design());
  const Evidence evidence = world.measure({}, {}, 1);
  // Pour 2 is 10 mm of water, pour 3 is 40 mm; their values change places.
  Evidence swapped = evidence;
  std::vector<std::size_t> two, three;
  for (std::size_t i = 0; i < evidence.observations.size(); ++i) {
    if (evidence.observations[i].factors.pour == 2) two.push_back(i);
    if (evidence.observations[i].factors.pour == 3) three.push_back(i);
  }
  ASSERT_EQ(two.size(), three.size());
  for (std::size_t k = 0; k < two.size(); ++k)
    std::swap(swapped.observations[two[k]].value, swapped.observations[three[k]].value);
  const auto found = warnings(swapped);
  EXPECT_TRUE(std::any_of(found.begin(), found.end(),
                          [](const std::string& w) { return w.find("swapped") != std::string::npos; }));
}

TEST(Hygiene, SeesACopiedPlacement) {
  const World world(small_design());
  Evidence evidence = world.measure({}, {}, 1);
  std::vector<std::size_t> one, other;
  for (std::size_t i = 0; i < evidence.observations.size(); ++i) {
    if (evidence.observations[i].factors.placement == 7) one.push_back(i);
    if (evidence.observations[i].factors.placement == 8) other.push_back(i);
  }
  for (std::size_t k = 0; k < one.size(); ++k) {
    evidence.observations[other[k]].value = evidence.observations[one[k]].value;
    evidence.observations[other[k]].repeat_sd = evidence.observations[one[k]].repeat_sd;
  }
  const auto found = warnings(evidence);
  EXPECT_TRUE(std::any_of(found.begin(), found.end(),
                          [](const std::string& w) { return w.find("identical") != std::string::npos; }));
}

/// Heights of one filling of water, as measured and as predicted.
Evidence water(double fill_mm, const Eigen::VectorXd& measured_mm, const Eigen::VectorXd& predicted_mm) {
  Evidence evidence;
  evidence.predicted = predicted_mm;
  for (const double height_mm : measured_mm) {
    Observation& observation = evidence.observations.emplace_back();
    observation.observable = "height_mm";
    observation.value = height_mm;
    observation.factors.liquid = "water";
    observation.factors.fill_mm = fill_mm;
  }
  return evidence;
}

TEST(Hygiene, APourThatIsFarOffIsNamedWithItsSessionAndAgainstTheModel) {
  Evidence evidence = water(30.0, Eigen::Vector4d(12.0, 12.0, 33.5, 12.0), Eigen::Vector4d::Constant(12.0));
  for (int session = 0; session < 4; ++session) evidence.observations[session].factors.session = session;
  const auto found = warnings(evidence);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0],
            "pour 0 of session 2 (water 30 mm) reads +21.5 mm off what the model has, where the middle of all pours is "
            "+0.0 mm off: another cup or filling?");
}

TEST(Hygiene, AReadingThatStandsAloneIsNamed) {
  Evidence evidence = water(20.0, Eigen::Vector4d(12.2, 12.1, -12.0, 12.4), Eigen::Vector4d::Constant(12.0));
  for (Observation& observation : evidence.observations)
    observation.factors.region = "interior", observation.factors.distance_mm = 250.0;
  const auto found = warnings(evidence);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0],
            "one reading of water 20 mm (session 0, pour 0, 250 mm away) is -24.0 mm off what the model has, where the "
            "other 3 are +0.1 to +0.4 mm off: a typing error?");
  evidence.observations[0].value = 0.0;  // where more scatter, none stands alone
  EXPECT_TRUE(warnings(evidence).empty());
}

TEST(Hygiene, HeightsThatAreAllAlikeAreNamedWhereTheyShouldDiffer) {
  Evidence evidence = water(20.0, Eigen::Vector4d::Constant(20.0), Eigen::Vector4d(20.1, 20.0, 20.0, 20.1));
  EXPECT_TRUE(warnings(evidence).empty());
  evidence.predicted = Eigen::Vector4d(17.0, 19.0, 21.0, 22.0);
  EXPECT_EQ(warnings(evidence), std::vector<std::string>{"all 4 heights are 20 mm: is this column another quantity?"});
}

/// Walls of four cups that stand so far beside their places.
Evidence cups_beside(double x_mm, double y_mm) {
  Evidence evidence;
  for (int placement = 1; placement <= 4; ++placement)
    for (const auto& [observable, value] : {std::pair("cup_x_mm", x_mm), std::pair("cup_y_mm", y_mm)}) {
      Observation walls;
      walls.observable = observable;
      walls.value = value;
      walls.factors.placement = placement;
      evidence.observations.push_back(walls);
    }
  evidence.predicted = Eigen::VectorXd::Zero(8);
  return evidence;
}

TEST(Hygiene, KnowsWhereAColourCameraSeesCups) {
  const auto found = warnings(cups_beside(-24.6, 0.3));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].find("colour camera"), std::string::npos);
  EXPECT_TRUE(warnings(cups_beside(24.6, 0.3)).empty());
  EXPECT_TRUE(warnings(cups_beside(-20.0, -15.0)).empty());
}

TEST(Screen, FindsAPlantedTripleAmongAllSets) {
  const World world(small_design());
  const std::vector<std::string> names{"radial_distortion", "meniscus", "wall_albedo"};
  std::vector<EffectValue> truth;
  std::vector<int> planted;
  for (const std::string& name : names) {
    truth.push_back(world.at_strength(name, 20.0, 1.0));
    planted.push_back(world.candidate(name));
  }
  std::sort(planted.begin(), planted.end());
  const Evidence evidence = world.measure(truth, {}, 6);
  const Problem problem = whitened_problem(evidence, estimate_covariance(evidence, residual_of(evidence)));
  const std::vector<Hypothesis> sets = screen(problem, 5);
  const Hypothesis* best = &sets.front();
  for (const Hypothesis& set : sets)
    if (set.log_evidence > best->log_evidence) best = &set;
  EXPECT_EQ(best->effects, planted);
}

/// An effect in all liquids and in one of them: the two in each liquid say the same.
TEST(Screen, HoldsNoEffectTwice) {
  const World world(small_design());
  Evidence evidence = world.measure({world.at_strength("fill_offset", 20.0, 1.0)}, {}, 6);
  const int everywhere = world.candidate("fill_offset");
  for (const char* liquid : {"water", "milk_tea"}) {
    Candidate one = evidence.candidates[everywhere];
    one.effect += std::string("@") + liquid;
    for (std::size_t i = 0; i < evidence.observations.size(); ++i)
      if (evidence.observations[i].factors.liquid != liquid)
        one.sensitivity.row(static_cast<Eigen::Index>(i)).setZero();
    evidence.candidates.push_back(one);
  }
  const int in_water = static_cast<int>(evidence.candidates.size()) - 2, in_tea = in_water + 1;
  const Problem problem = whitened_problem(evidence, estimate_covariance(evidence, residual_of(evidence)));
  bool has_both_liquids = false;
  for (const Hypothesis& set : screen(problem, 60)) {
    EXPECT_FALSE(holds_any(set.effects, {everywhere}) && holds_any(set.effects, {in_water, in_tea}));
    has_both_liquids |= set.effects == std::vector{in_water, in_tea};
  }
  EXPECT_TRUE(has_both_liquids);
}

/// A cloud is registered to the colour camera or it is not: a ninth of that explains nothing.
TEST(Screen, WhatIsThereOrNotIsThereAsAWhole) {
  Evidence evidence;
  evidence.observations.resize(2);
  evidence.observations[0].value = 3.0;
  evidence.predicted = Eigen::VectorXd::Zero(2);
  evidence.numerical_sd = Eigen::VectorXd::Constant(2, 0.1);
  Candidate there{"there", {{"there", 0.0, 1.0, 0.0, 1.0, 1.0}}, Eigen::Vector2d(25.0, 0.0)};
  evidence.candidates = {there};
  Covariance covariance;
  covariance.total = 0.01 * Eigen::MatrixXd::Identity(2, 2);
  covariance.factor.compute(covariance.total);
  const std::vector<Hypothesis> sets = screen(whitened_problem(evidence, covariance), 5);
  ASSERT_EQ(sets.size(), 1u);
  EXPECT_EQ(sets[0].parameters[0], 1.0);
  EXPECT_LT(sets[0].gain, 0.0);
}

TEST(NextMeasurement, ThatSeesOneTwinAndNotTheOtherSettlesIt) {
  const World world(small_design());
  const Evidence evidence = world.measure({}, {}, 1);
  const Covariance covariance = estimate_covariance(evidence, residual_of(evidence));
  const int bottom = world.candidate("cup_bottom_height"), coaster = world.candidate("cup_on_coaster");
  // A gauge block at the rim, read to 0.05 mm, sees a coaster, which lifts the whole cup, but no bottom.
  Design gauge{"gauge block", 1.0, {}};
  gauge.evidence.observations = {
      {.observable = "gauge_mm", .factors = {.session = 9, .liquid = "empty", .region = ""}}};
  gauge.evidence.numerical_sd = Eigen::VectorXd::Constant(1, 0.05);
  gauge.evidence.candidates = {{"cup_on_coaster", {}, Eigen::MatrixXd::Constant(1, 1, 0.5)}};
  Design blind = gauge;
  blind.name = "another look at nothing";
  blind.evidence.candidates.clear();

  const Eigen::VectorXd none = Eigen::VectorXd::Zero(residual_of(evidence).size()), raised = none.array() + 1.0;
  const Option is_bottom{{bottom}, Eigen::VectorXd::Constant(1, 1.0), false, 0.0, raised};
  const Option is_coaster{{coaster}, Eigen::VectorXd::Constant(1, 2.0), false, 0.0, raised};
  EXPECT_NEAR(t_criterion(evidence, covariance, blind, is_bottom, is_coaster), 0.0, 1e-6);
  // 1 mm seen with 0.05 mm, less what the campaign leaves uncertain of the size.
  EXPECT_GT(t_criterion(evidence, covariance, gauge, is_bottom, is_coaster), 3.0);
  // A coaster that is there would be told from nothing at all.
  const Option is_nothing{{}, {}, false, 0.0, none};
  const double told_from_nothing = t_criterion(evidence, covariance, gauge, is_nothing, is_coaster);
  EXPECT_GT(told_from_nothing, 3.0);
  // What the campaign itself says of a coaster is no merit of another look at nothing.
  EXPECT_NEAR(t_criterion(evidence, covariance, blind, is_nothing, is_coaster), 0.0, 1e-6);
  // What may lift the gauge by any amount where there is a coaster excuses coasters, and nothing else.
  Design shaky = gauge;
  shaky.evidence.candidates[0].leeway.columns = Eigen::MatrixXd::Constant(1, 1, 1e3);
  EXPECT_NEAR(t_criterion(evidence, covariance, shaky, is_bottom, is_coaster), 0.0, 0.01);
  EXPECT_NEAR(t_criterion(evidence, covariance, shaky, is_nothing, is_coaster), told_from_nothing, 1e-9);

  const AmbiguitySet set{{{.options = {is_bottom, is_coaster}, .probability = 1.0}}};
  const auto next = next_measurements(
      evidence, covariance,
      [&](const std::vector<std::string>&) {
        return std::vector{blind, gauge};
      },
      set);
  ASSERT_EQ(next.size(), 1U);
  EXPECT_EQ(next[0].measurement, "gauge block");
  // What is too small to show is not asked after.
  Option is_hardly = is_coaster;
  is_hardly.prediction = none;
  EXPECT_TRUE(next_measurements(evidence, covariance,
                                [&](const std::vector<std::string>&) { return std::vector{gauge}; },
                                {{{.options = {is_nothing, is_hardly}, .probability = 1.0}}})
                  .empty());
}

}  // namespace
}  // namespace fathom
