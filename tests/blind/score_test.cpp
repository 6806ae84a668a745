// The scorer on answers written by hand.
#include <gtest/gtest.h>

#include <filesystem>

#include "blind/curves.h"
#include "blind/goals.h"
#include "blind/settle.h"
#include "core/files.h"

namespace fathom::blind {
namespace {

namespace fs = std::filesystem;

Answer answer_of(const std::string& json, const std::string& next = "[]") {
  const fs::path folder = fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
  make_directory(folder);
  write_text(folder / "report.json", json);
  write_text(folder / "next.json", next);
  const Answer answer = read_answer(folder);
  fs::remove_all(folder);
  return answer;
}

SetTruth single(const char* name, double departure, double s) {
  SetTruth truth{.kind = "single", .design = "full"};
  truth.effects.push_back({{&hidden_effect(name), departure}, s});
  truth.strength_by_liquid = {{"water", s}, {"milk_tea", 0.5}};
  return truth;
}

const std::string kIndexNamed = R"({"verdict": "named",
  "effects": [{"name": "refractive_index@water", "parameters": {"index_change": {"value": 0.01, "ci95": [0.008, 0.012]}}}],
  "ambiguity_set": [{"effects": [], "probability": 0.04}, {"effects": ["refractive_index@water"], "probability": 0.96}],
  "where": [{"observable": "height_mm", "stratum": "liquid=water, distance_mm=300", "p": 1e-6}],
  "gap": {"held_out": {"before_rms_mm": 1.3, "after_rms_mm": 0.5, "noise_floor_mm": 0.5}}})";

const Goal& goal(const std::vector<Goal>& goals, const std::string& metric) {
  for (const Goal& one : goals)
    if (one.metric == metric) return one;
  throw std::logic_error(metric);
}

TEST(BlindScore, ARightAnswerScoresEverywhere) {
  const std::vector<Judged> judged(2, {single("refractive_index", 0.011, 9.0), answer_of(kIndexNamed)});
  const std::vector<Goal> goals = goals_of(judged);
  for (const char* metric : {"single effect first, s ≥ 8", "truth in the ambiguity set",
                             "parameter within its 95 % interval", "localisation F1 over liquids",
                             "gap closed on held-out conditions, s ≥ 8", "held-out RMS over noise floor, s ≥ 8"})
    EXPECT_NEAR(goal(goals, metric).value, 1.0, 1e-12) << metric;
  EXPECT_EQ(goal(goals, "confidently wrong").value, 0.0);
  EXPECT_EQ(goal(goals, "single effect first, s ≥ 8").verdict(), "open") << "two sets prove nothing";
}

TEST(BlindScore, AValueOutsideOfItsTwoLimitsIsMissed) {
  Goal goal{
      .value = 0.915, .low = 0.8, .high = 0.976, .trials = 47, .want = Want::between, .bar = 0.93, .bar_high = 0.97};
  EXPECT_EQ(goal.verdict(), "missed");
  goal.value = 0.95;
  EXPECT_EQ(goal.verdict(), "open");
}

TEST(BlindScore, AWrongAnswerIsConfidentlyWrong) {
  const std::vector<Judged> judged{{single("meniscus", -20.0, 9.0), answer_of(kIndexNamed)},
                                   {SetTruth{.kind = "null", .design = "full"}, answer_of(kIndexNamed)}};
  const std::vector<Goal> goals = goals_of(judged);
  EXPECT_EQ(goal(goals, "single effect first, s ≥ 8").value, 0.0);
  EXPECT_EQ(goal(goals, "names something on a null set").value, 1.0);
  EXPECT_EQ(goal(goals, "confidently wrong").value, 1.0);
  EXPECT_EQ(worst_table(judged).rows(), 2u);
  EXPECT_EQ(reliability_table(judged).number(0, "true"), 0.0);
}

TEST(BlindScore, AGapOfNoLiquidInParticularIsInAll) {
  SetTruth truth = single("sensor_height", 3.0, 12.0);
  truth.strength_by_liquid = {{"empty", 6.0}, {"water", 8.0}, {"milk_tea", 2.0}};
  const auto f1 = [&](const char* where) {
    const Answer answer = answer_of(std::string(R"({"verdict": "unknown", "where": [)") + where + "]}");
    return goal(goals_of(std::vector<Judged>{{truth, answer}}), "localisation F1 over liquids").value;
  };
  EXPECT_DOUBLE_EQ(f1(R"({"stratum": "distance_mm=300", "p": 1e-5})"), 0.8);                 // two right, one wrong
  EXPECT_DOUBLE_EQ(f1(R"({"stratum": "liquid=water, fill_mm=30", "p": 1e-5})"), 2.0 / 3.0);  // one right, one missed
  EXPECT_DOUBLE_EQ(f1(R"({"stratum": "distance_mm=300", "p": 0.2})"), 0.0);
}

TEST(BlindScore, NoAnswerIsNoGoodAnswer) {
  const std::vector<Judged> judged{{SetTruth{.kind = "null", .design = "full"}, read_answer("/no/such/folder")}};
  const std::vector<Goal> goals = goals_of(judged);
  EXPECT_EQ(goal(goals, "names something on a null set").value, 1.0);
  EXPECT_EQ(goal(goals, "answered").value, 0.0);
}

TEST(BlindScore, AliasedEffectsHaveToBeSaidToBe) {
  SetTruth truth = single("fill_offset", 1.0, 9.0);
  truth.kind = "aliased";
  truth.aliased = {"cup_bottom_height", "fill_offset"};
  const Answer both = answer_of(R"({"verdict": "ambiguous", "ambiguity_set": [
    {"effects": ["cup_bottom_height"], "indistinguishable": [["fill_offset"]], "probability": 0.99}]})");
  const Answer one = answer_of(R"({"verdict": "named", "effects": [{"name": "fill_offset"}], "ambiguity_set": [
    {"effects": ["fill_offset"], "probability": 0.99}]})");
  EXPECT_EQ(goal(goals_of(std::vector<Judged>{{truth, both}}), "aliased effects called ambiguous").value, 1.0);
  EXPECT_EQ(goal(goals_of(std::vector<Judged>{{truth, one}}), "aliased effects called ambiguous").value, 0.0);
}

TEST(BlindScore, WhatIsLeftOpenBesideTheFirstIsNoError) {
  SetTruth truth = single("fill_offset", 1.0, 9.0);
  truth.kind = "pair";
  truth.effects.push_back({{&hidden_effect("absorption"), 0.001}, 2.0});
  const auto wrong = [&](const std::string& supersets) {
    const Answer answer = answer_of(R"({"verdict": "named", "effects": [{"name": "fill_offset"}], "ambiguity_set": [
      {"effects": ["fill_offset"], "probability": 0.99, "supersets": )" +
                                    supersets + "}]}");
    const std::vector<Goal> goals = goals_of(std::vector<Judged>{{truth, answer}});
    return goal(goals, "confidently wrong").value + (1.0 - goal(goals, "truth in the ambiguity set").value);
  };
  EXPECT_EQ(wrong(R"([["absorption", "fill_offset"]])"), 0.0);
  EXPECT_EQ(wrong(R"([["fill_offset", "meniscus"]])"), 2.0);
}

/// Two that are each left open beside the first may be there together.
TEST(BlindScore, WhatIsLeftOpenTwiceIsLeftOpenTogether) {
  SetTruth truth = single("fill_offset", 1.0, 9.0);
  truth.kind = "triple";
  truth.effects.push_back({{&hidden_effect("absorption"), 0.001}, 2.0});
  truth.effects.push_back({{&hidden_effect("meniscus"), 5.0}, 2.0});
  const auto wrong = [&](const std::string& second) {
    const Answer answer = answer_of(R"({"verdict": "named", "effects": [{"name": "fill_offset"}], "ambiguity_set": [
      {"effects": ["fill_offset"], "probability": 0.99, "supersets": [["absorption", "fill_offset"], ["fill_offset", ")" +
                                    second + R"("]]}]})");
    return goal(goals_of(std::vector<Judged>{{truth, answer}}), "confidently wrong").value;
  };
  EXPECT_EQ(wrong("meniscus"), 0.0);
  EXPECT_EQ(wrong("ripples"), 1.0);
}

TEST(BlindScore, UnknownIsFlaggedByItsVerdict) {
  SetTruth truth = single("wall_caustic", 0.5, 12.0);
  truth.kind = "unknown";
  truth.escape = 11.0;
  const Answer flagged =
      answer_of(R"({"verdict": "unknown", "ambiguity_set": [{"effects": ["unknown"], "probability": 0.97}]})");
  const auto goals = goals_of(std::vector<Judged>{{truth, flagged}, {truth, answer_of(kIndexNamed)}});
  EXPECT_EQ(goal(goals, "unknown flagged, escape ≥ 10").value, 0.5);
  EXPECT_EQ(goal(goals, "confidently wrong, escape ≥ 8").value, 0.5);
}

TEST(BlindScore, PowerStandsBesideTheMatchedFilter) {
  const std::vector<Judged> judged(4, {single("refractive_index", 0.011, 2.326), answer_of(kIndexNamed)});
  const Table power = power_table(judged);
  ASSERT_EQ(power.rows(), 1u);
  EXPECT_NEAR(power.number(0, "matched_filter"), 0.5, 1e-4);  // Φ(0)
  EXPECT_EQ(power.number(0, "detected"), 1.0);
}

TEST(BlindScore, DetectionIsHeldAgainstTheMatchedFilter) {
  const Answer silent = answer_of(R"({"verdict": "none", "ambiguity_set": [{"effects": [], "probability": 0.9}]})");
  const char* metric = "matched filter's power less detected share";
  const auto behind = [&](double s, const std::vector<Answer>& answers) {
    std::vector<Judged> judged;
    for (const Answer& answer : answers) judged.push_back({single("refractive_index", 0.011, s), answer});
    return goal(goals_of(judged), metric);
  };
  // Half of what such a filter sees at s = 2.326 may be missed; of what it always sees, nothing.
  EXPECT_NEAR(behind(2.32635, {silent, answer_of(kIndexNamed)}).value, 0.0, 1e-4);
  EXPECT_NEAR(behind(9.0, {silent, answer_of(kIndexNamed)}).value, 0.5, 1e-6);
  EXPECT_EQ(behind(9.0, {silent, silent}).verdict(), "missed");
  EXPECT_NEAR(behind(9.0, {read_answer("/no/such/folder"), silent}).value, 1.0, 1e-6);
}

TEST(BlindScore, FiltersThatAreGivenTheAnswersErrorsKnowNoMoreThanThose) {
  const char* silent = R"({"verdict": "none", "size_errors": [
      {"name": "refractive_index", "parameter": "index_change", "liquid": "water", "standard_error": 1e-6},
      {"name": "refractive_index", "parameter": "index_change", "standard_error": 0.004729}]})";
  const auto goals = goals_of(std::vector<Judged>(2, {single("refractive_index", 0.011, 9.0), answer_of(silent)}));
  EXPECT_NEAR(goal(goals, "matched filter's power less detected share").value, 1.0, 1e-6);
  EXPECT_NEAR(goal(goals, "matched filter with the diagnosis's covariance: power less detected share").value, 0.5,
              1e-3);  // s = 2.326
  // Of 76 filters each has 1 % / 76 false alarms, so its threshold is 3.649: Φ(2.326 − 3.649) = 0.0929.
  EXPECT_NEAR(goal(goals, "a bank of such filters, one for each effect and sign: power less detected share").value,
              0.0929, 1e-3);
}

/// Aliased effects of which one is hidden, and what an answer proposes to tell them apart.
struct BlindFollowUp : testing::Test {
  SetTruth truth = single("fill_offset", 1.0, 9.0);
  Answer before = answer_of(R"({"verdict": "ambiguous", "ambiguity_set": [
    {"effects": ["cup_bottom_height"], "indistinguishable": [["fill_offset"]], "probability": 0.99},
    {"effects": ["foam"], "probability": 0.01}]})",
                            R"([
    {"measurement": "more milk", "separates": ["foam", "fill_offset"], "sigma": 4.0, "campaign": "next_1.json"},
    {"measurement": "bare desk", "separates": ["foam@milk_tea", "foam"], "sigma": 7.0, "campaign": "next_2.json"},
    {"measurement": "the empty cup", "separates": ["cup_bottom_height", "fill_offset"], "sigma": 9.0, "campaign": "next_3.json"},
    {"measurement": "clear water", "separates": ["cup_bottom_height", "foam"], "sigma": 9.0, "campaign": "next_4.json"},
    {"measurement": "the empty cup", "separates": ["fill_offset", "fill_offset+foam"], "sigma": 8.0, "campaign": "next_3.json"},
    {"measurement": "the empty cup", "separates": ["none", "fill_offset@milk_tea"], "sigma": 6.0, "campaign": "next_3.json"}])");
  BlindFollowUp() {
    truth.kind = "aliased";
    truth.aliased = {"cup_bottom_height", "fill_offset"};
  }

  /// "settled", "told apart", "open", or "" where there is nothing to judge.
  std::string outcome(const std::string& ambiguity_set) const {
    const Judged one{truth, before, answer_of(R"({"verdict": "ambiguous", "ambiguity_set": )" + ambiguity_set + "}")};
    const Goal settled = goal(goals_of(std::vector{one}), "settled by what was proposed at 6 σ");
    EXPECT_EQ(settled.hits, is_settled(one));
    return settled.trials == 0 ? "" : is_settled(one) ? "settled" : is_told_apart(one) ? "told apart" : "open";
  }
};

TEST_F(BlindFollowUp, IsTheFirstMeasurementThatTellsEffectsApartBySixSigma) {
  const std::optional<Promise> promise = promise_of(before);
  ASSERT_TRUE(promise);
  EXPECT_EQ(promise->spec, "next_3.json");  // before it one is too weak, one of two liquids
  ASSERT_EQ(promise->pairs.size(), 3u);
  // Nothing excludes that foam is there as well.
  EXPECT_EQ(rivals({truth, before}), (std::vector<Names>{{"cup_bottom_height"}, {}}));
  Answer sure = before;
  sure.ambiguity_set = {{.sets = {{"fill_offset"}}, .supersets = {}, .probability = 1.0}};
  EXPECT_FALSE(promise_of(sure));
}

TEST_F(BlindFollowUp, SettlesWhenWhatIsHiddenStandsFirstWithoutItsRivals) {
  EXPECT_EQ(outcome(R"([{"effects": ["fill_offset"], "probability": 0.9}, {"effects": ["foam"], "probability": 0.1}])"),
            "settled");
  EXPECT_EQ(outcome(R"([{"effects": ["foam"], "probability": 0.9}, {"effects": ["fill_offset"], "probability": 0.1}])"),
            "told apart");
  EXPECT_EQ(outcome(R"([{"effects": ["fill_offset"], "probability": 0.9999},
                        {"effects": ["cup_bottom_height"], "probability": 0.0001}])"),
            "open");
  EXPECT_EQ(outcome(R"([{"effects": ["fill_offset"], "probability": 0.9}, {"effects": [], "probability": 0.1}])"),
            "open");
  EXPECT_EQ(outcome(R"([{"effects": ["foam"], "probability": 1.0}])"), "open");
}

TEST_F(BlindFollowUp, IsNotJudgedWhereWhatIsHiddenWasInNoPair) {
  truth.effects.front().active.effect = &hidden_effect("meniscus");
  EXPECT_EQ(outcome(R"([{"effects": ["meniscus"], "probability": 1.0}])"), "");
  truth = SetTruth{.kind = "null", .design = "full"};  // nothing: part of all that there may be
  EXPECT_EQ(outcome(R"([{"effects": [], "probability": 1.0}])"), "");
  truth = single("wall_caustic", 0.5, 12.0);
  truth.kind = "unknown";
  EXPECT_EQ(outcome(R"([{"effects": ["unknown"], "probability": 1.0}])"), "");
}

TEST_F(BlindFollowUp, WithoutAnAnswerSettlesNothing) {
  const Judged one{truth, before, read_answer("/no/such/folder")};
  EXPECT_TRUE(is_followed_up(one));
  EXPECT_FALSE(is_settled(one));
  EXPECT_FALSE(is_followed_up({truth, before}));
}

}  // namespace
}  // namespace fathom::blind
