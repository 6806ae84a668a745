// What a diagnosis promises to say, whatever it was of.
#include "report/diagnosis_words.h"

#include <gtest/gtest.h>

#include "report/effect_words.h"

namespace fathom {
namespace {

bool says(const Diagnosis& diagnosis, std::string_view words) {
  return answer(diagnosis).find(words) != std::string::npos;
}

Diagnosis agreement(double probability) {
  Diagnosis diagnosis;
  diagnosis.verdict = Verdict::none;
  diagnosis.probability_of_none = probability;
  diagnosis.budget.push_back({"water, 20 mm, at (0, 300) mm", "height_mm"});
  return diagnosis;
}

TEST(DiagnosisWords, AgreementThatHardlyHoldsIsSaidLessRoundly) {
  EXPECT_TRUE(says(agreement(0.9), "agree within their errors"));
  EXPECT_FALSE(says(agreement(0.2), "agree within their errors"));
  EXPECT_TRUE(says(agreement(0.2),
                   "No effect is sure enough to be named, but the probability that nothing is missing is only 20 %."));
}

TEST(DiagnosisWords, WhatIsLikeliestStandsBesideADoubtfulAgreement) {
  Diagnosis diagnosis = agreement(0.2);
  diagnosis.ambiguity_set = {{{}, {}, {}, 0.2}, {{"sensor_height"}, {}, {}, 0.6}};
  EXPECT_TRUE(says(diagnosis, "The likeliest is sensor height (60 %)."));
}

/// Heights of one session share an error, so that few errors make a wide gap.
TEST(DiagnosisWords, AWideGapIsNotWavedThrough) {
  Diagnosis diagnosis = agreement(0.6);
  diagnosis.gap.train = {2.0, 1.9, 0.65};
  EXPECT_TRUE(says(diagnosis, "or something differs there."));
  EXPECT_TRUE(advice(diagnosis).front().starts_with("Look in heights.png"));
  diagnosis.gap.train = {2.0, 0.6, 0.65};
  EXPECT_FALSE(says(diagnosis, "something differs"));
}

TEST(DiagnosisWords, ThatAnEffectIsThereIsNoSizeUnlessItIsNot) {
  const auto shown = [](double law) {
    return shown_parameters({"depth_quantization", {{"law", law, 0.0, 1.0}, {"step_px", 0.25, 0.2, 0.3}}}).size();
  };
  EXPECT_EQ(shown(1.0), 1u);
  EXPECT_EQ(shown(0.0), 2u);
}

TEST(DiagnosisWords, ThirdsOfASessionAreNoValues) {
  EXPECT_EQ(stratum_words({"height_mm", "time=early"}), "height in the cup, in the first third of the session");
  EXPECT_EQ(stratum_words({"height_mm", "time_since_pour=late"}),
            "height in the cup, in the last third of the time since the pour");
  EXPECT_EQ(stratum_words({"height_mm", "liquid=milk_tea, fill_mm=20"}),
            "height in the cup, in milk tea, at a fill of 20 mm");
  EXPECT_EQ(place_words("distance_mm=300, lateral_mm=-60"), "300 mm away, 60 mm to the left");
}

TEST(DiagnosisWords, AScatteringThatMayBeInfiniteIsSaidAsItsLength) {
  const auto clause = [](double least_mm) {
    return effect_clause({"subsurface_scattering", {{"transport_length_mm", 0.5, least_mm, 1.0}}});
  };
  EXPECT_NE(clause(0.25).find("scattering = 2.0 per mm (95 %: 1.0 to 4.0)"), std::string::npos) << clause(0.25);
  EXPECT_NE(clause(0.0).find("transport length = 0.50 mm (95 %: 0.00 to 1.00)"), std::string::npos) << clause(0.0);
}

TEST(DiagnosisWords, OfManyPairsThatNothingTellsApartTheLikeliestAreNamed) {
  Diagnosis diagnosis;
  diagnosis.verdict = Verdict::ambiguous;
  diagnosis.ambiguity_set = {{{"foam"}, {}, {}, 0.6}, {{"baseline"}, {}, {}, 0.4}};
  for (const char* other : {"baseline", "meniscus", "ripples", "absorption", "fill_scale"})
    diagnosis.next.push_back({"bare desk", {{"foam"}, {other}}, 1.0});
  EXPECT_TRUE(says(diagnosis, "foam from baseline, foam from meniscus, foam from ripples or 2 more pairs."));
  EXPECT_FALSE(says(diagnosis, "absorption"));
}

TEST(DiagnosisWords, WhereIsSaidByThePlainMeanOfWhatDeparts) {
  Diagnosis diagnosis = agreement(0.001);
  diagnosis.verdict = Verdict::unknown;
  diagnosis.departures.where = {{"height_mm", "liquid=milk", 2.5, 0.3, 0.8, 1e-6, 3.3}};
  EXPECT_TRUE(says(diagnosis, "In milk, the height in the cup is 3.3 mm higher than the model has it."));
  diagnosis.departures.where.front().departure = 0.1;
  EXPECT_TRUE(says(diagnosis,
                   "In milk, compared with the rest, the height in the cup is 2.5 mm higher than the model has it."));
}

TEST(DiagnosisWords, AMeanOfNothingIsNotSaid) {
  Diagnosis diagnosis;
  diagnosis.verdict = Verdict::named;
  diagnosis.effects = {{"fill_scale", {{"scale", 0.1, 0.08, 0.12}}}};
  diagnosis.departures.where = {{"height_mm", "liquid=milk", -0.03, 0.16, 1.0, 1e-5, 0.15}};
  EXPECT_TRUE(answer(diagnosis).starts_with("Best explanation"));
}

TEST(DiagnosisWords, WhereAnEffectIsNamedButNotItsLiquidsTheOthersAreSaid) {
  Diagnosis diagnosis;
  diagnosis.verdict = Verdict::named;
  diagnosis.effects = {{"fill_scale", {{"scale", 0.1, 0.08, 0.12}}}};
  diagnosis.ambiguity_set = {{{"fill_scale"}, {{"fill_scale@milk"}}, {}, 1.0}};
  EXPECT_FALSE(says(diagnosis, "It is not sure in which liquids"));
  diagnosis.ambiguity_set.front().is_liquid_open = true;
  EXPECT_TRUE(says(diagnosis, "It is not sure in which liquids: it may also be fill scale of milk."));
}

TEST(DiagnosisWords, WhatAnEffectSaysIsNotSaidOfItsDepartureAsWell) {
  Diagnosis diagnosis;
  diagnosis.verdict = Verdict::named;
  diagnosis.effects = {{"sensor_height", {{"height_mm", 6.0, 4.5, 7.5}}}};
  diagnosis.departures.where = {{"desk_height_mm", "all", 6.2, 0.8, 1.0, 1e-6, 6.5}};
  EXPECT_TRUE(answer(diagnosis).starts_with("Best explanation: the sensor stands 6.0 mm (4.5 to 7.5 mm) higher"));
  diagnosis.departures.where.front().observable = "height_mm";
  EXPECT_TRUE(answer(diagnosis).starts_with("The height in the cup is 6.5 mm higher"));
}

TEST(DiagnosisWords, EachVerdictSaysWhatToDo) {
  EXPECT_EQ(advice(agreement(0.9)).size(), 1u);
  Diagnosis diagnosis;
  diagnosis.verdict = Verdict::named;
  diagnosis.effects = {{"fill_scale", {{"relative", 0.1, 0.08, 0.12}}}};
  EXPECT_EQ(advice(diagnosis).front(), "Check fill scale by weighing the cup at two fills.");
  diagnosis.effects.clear();
  diagnosis.verdict = Verdict::unknown;
  EXPECT_EQ(advice(diagnosis).size(), 1u);
  diagnosis.departures.excess = {{"session", "1", "height_mm", "", 2.3, 0.3, 1e-6}};
  EXPECT_TRUE(advice(diagnosis).front().starts_with("Look at what changed between the sessions"));
}

TEST(DiagnosisWords, ASizeAtItsBoundIsSaidToBeAtLeastThat) {
  Diagnosis diagnosis;
  diagnosis.verdict = Verdict::named;
  diagnosis.effects = {{"disparity_offset", {{"offset_px", -3.0, -3.0, -2.32}}}};
  EXPECT_TRUE(says(diagnosis, "all disparities at least 2.32 px (3 px is the most that is considered) too small"));
  diagnosis.effects = {{"disparity_offset", {{"offset_px", -1.0, -1.2, -0.8}}}};
  EXPECT_TRUE(says(diagnosis, "all disparities 1.00 px (0.80 to 1.20 px) too small"));
}

}  // namespace
}  // namespace fathom
