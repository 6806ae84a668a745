// What a diagnosis promises to say, whatever it was of.
#include "report/diagnosis_words.h"

#include <gtest/gtest.h>

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
                   "Nothing is sure enough to be named, but that model and measurement agree is only 20 % sure"));
}

TEST(DiagnosisWords, ThirdsOfASessionAreNoValues) {
  EXPECT_EQ(stratum_words({"height_mm", "time=early"}), "height in the cup in the first third of the session");
  EXPECT_EQ(stratum_words({"height_mm", "time_since_pour=late"}),
            "height in the cup in the last third of the time since the pour");
  EXPECT_EQ(stratum_words({"height_mm", "liquid=milk_tea, fill_mm=20"}),
            "height in the cup where liquid is milk tea and fill is 20 mm");
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
  EXPECT_TRUE(says(diagnosis, "Where liquid is milk, the height in the cup is 3.3 mm higher than the model has it."));
  diagnosis.departures.where.front().departure = 0.1;
  EXPECT_TRUE(says(diagnosis, "the height in the cup is 2.5 mm higher, beside the rest, than the model has it."));
}

TEST(DiagnosisWords, ASizeAtItsBoundIsSaidToBeAtLeastThat) {
  Diagnosis diagnosis;
  diagnosis.verdict = Verdict::named;
  diagnosis.effects = {{"disparity_offset", {{"offset_px", -3.0, -3.0, -2.32}}}};
  EXPECT_TRUE(says(diagnosis, "all disparities at least 2.32 px (3 px is the most that is considered) too small"));
  diagnosis.effects = {{"disparity_offset", {{"offset_px", -1.0, -1.2, -0.8}}}};
  EXPECT_TRUE(says(diagnosis, "all disparities 1 px (0.8 to 1.2 px) too small"));
}

}  // namespace
}  // namespace fathom
