// Notes that are wrong are put right by exactly what is wrong with them; notes that are right are left alone.
#include "diagnosis/predict/bookkeeping.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "diagnosis/predict/predictor.h"
#include "tests/diagnosis/predict/paper_measurement.h"

namespace fathom {
namespace {

void leave_out_unseen(Measurement& measurement) {
  std::erase_if(measurement.observations, [](const Observation& o) { return !std::isfinite(o.value); });
}

/// What the model itself predicts was measured, apart from 0.1 mm up and down, of fills so many times as deep.
Measurement measured(double deeper = 1.0) {
  Measurement measurement = paper_measurement(false);
  for (Observation& o : measurement.observations) o.factors.fill_mm *= deeper;
  const Eigen::VectorXd values = Predictor(measurement.rig, measurement.observations).predict({});
  for (std::size_t i = 0; i < measurement.observations.size(); ++i)
    measurement.observations[i].value = values[static_cast<Eigen::Index>(i)] + (i % 2 ? 0.1 : -0.1);
  leave_out_unseen(measurement);
  return measurement;
}

void put_right(Measurement& measurement) { put_bookkeeping_right(Json::array(), "rig.json", measurement); }

TEST(Bookkeeping, RightNotesAreLeftAlone) {
  Measurement measurement = measured();
  put_right(measurement);
  EXPECT_TRUE(measurement.mistakes.empty());
}

TEST(Bookkeeping, FillsInCentimetresAreFound) {
  Measurement measurement = measured();
  for (Observation& o : measurement.observations) o.factors.fill_mm *= 0.1;
  const auto poured = std::find_if(measurement.observations.begin(), measurement.observations.end(),
                                   [](const Observation& o) { return o.factors.fill_mm > 0.0; });
  FrameRecord frame;
  frame.liquid = poured->factors.liquid, frame.fill_m = metres_from_mm(poured->factors.fill_mm);
  const double written_m = frame.fill_m;
  measurement.frames.push_back(frame);
  put_right(measurement);
  ASSERT_EQ(measurement.mistakes.size(), 1u);
  EXPECT_EQ(measurement.mistakes[0].id, "unit_error");
  EXPECT_NEAR(measurement.frames.back().fill_m, 10.0 * written_m, 1e-12);
  const Measurement truth = measured();
  for (std::size_t i = 0; i < truth.observations.size(); ++i)
    EXPECT_NEAR(measurement.observations[i].factors.fill_mm, truth.observations[i].factors.fill_mm, 1e-9);
}

// Above 5.4 mm there should be wall alone; a liquid that in truth stands at 54 mm was taken for some.
TEST(Bookkeeping, WallsSoughtBelowALiquidDoNotCount) {
  Measurement measurement = measured(1.8);
  for (const Observation& height : measured(1.8).observations) {
    if (height.factors.region != "centre") continue;
    Observation wall = height;
    wall.observable = "cup_radius_mm", wall.factors.region = "walls", wall.value = 0.0;
    measurement.observations.push_back(wall);
  }
  for (Observation& o : measurement.observations) o.factors.fill_mm *= 0.1;
  put_right(measurement);
  std::set<double> fills_mm;
  for (const Observation& o : measurement.observations)
    if (o.factors.region == "walls") fills_mm.insert(std::round(o.factors.fill_mm));
  EXPECT_EQ(fills_mm, (std::set<double>{0.0, 18.0}));
}

TEST(Bookkeeping, FillsInInchesInOneOfTwoSessionsAreFoundThere) {
  Measurement measurement = measured();
  const Measurement truth = measurement;
  for (Observation second : truth.observations) {
    second.factors.session = 2;
    second.factors.fill_mm /= 25.4;
    measurement.observations.push_back(second);
  }
  put_right(measurement);
  ASSERT_EQ(measurement.mistakes.size(), 1u);
  EXPECT_EQ(measurement.mistakes[0].sentence, "Fills of session 2 were written down in inches, not in millimetres.");
  for (std::size_t i = 0; i < measurement.observations.size(); ++i)
    EXPECT_NEAR(measurement.observations[i].factors.fill_mm,
                truth.observations[i % truth.observations.size()].factors.fill_mm, 1e-9);
}

TEST(Bookkeeping, OnlyThoseFillsAreChangedThatAreInCentimetres) {
  Measurement measurement = measured();
  const Measurement truth = measurement;
  const double fill_mm = 30.0;
  for (Observation& o : measurement.observations)
    if (o.factors.fill_mm == fill_mm) o.factors.fill_mm *= 0.1;
  put_right(measurement);
  ASSERT_EQ(measurement.mistakes.size(), 1u);
  EXPECT_EQ(measurement.mistakes[0].sentence, "Fills of 3 mm were written down in centimetres, not in millimetres.");
  for (std::size_t i = 0; i < truth.observations.size(); ++i)
    EXPECT_NEAR(measurement.observations[i].factors.fill_mm, truth.observations[i].factors.fill_mm, 1e-9);
}

TEST(Bookkeeping, ExchangedLabelsAreFound) {
  Measurement measurement = measured();
  for (Observation& o : measurement.observations)
    if (o.factors.liquid == "water")
      o.factors.liquid = "milk";
    else if (o.factors.liquid == "milk")
      o.factors.liquid = "water";
  measurement.frames.emplace_back().liquid = "milk";
  put_right(measurement);
  ASSERT_EQ(measurement.mistakes.size(), 1u);
  EXPECT_EQ(measurement.mistakes[0].id, "label_swap");
  EXPECT_EQ(measurement.frames.back().liquid, "water") << "a report leads from a height to its shot";
  const Measurement truth = measured();
  for (std::size_t i = 0; i < truth.observations.size(); ++i)
    EXPECT_EQ(measurement.observations[i].factors.liquid, truth.observations[i].factors.liquid);
}

/// As many pours of every filling, one after the other.
Measurement poured_often(int pours) {
  const Measurement once = measured();
  Measurement measurement = once;
  for (int pour = 1; pour < pours; ++pour)
    for (Observation o : once.observations) {
      o.factors.pour += 100 * pour, o.factors.placement += 100 * pour;
      o.factors.time_s += 1e4 * pour;
      o.value += pour % 2 ? 0.3 : -0.3;  // fills scatter
      measurement.observations.push_back(o);
    }
  return measurement;
}

/// Of one filling, in some pours.
void raise(Measurement& measurement, const std::string& liquid, double fill_mm, int first_pour, double by_mm) {
  for (Observation& o : measurement.observations)
    if (o.observable == "height_mm" && o.factors.liquid == liquid && o.factors.fill_mm == fill_mm &&
        o.factors.pour >= first_pour)
      o.value += by_mm;
}

TEST(Bookkeeping, APourThatHoldsSomethingElseIsLeftOut) {
  Measurement measurement = poured_often(3);
  raise(measurement, "milk", 10.0, 200, 20.0);
  const std::size_t before = measurement.observations.size();
  put_right(measurement);
  ASSERT_EQ(measurement.mistakes.size(), 1u);
  EXPECT_EQ(measurement.mistakes[0].id, "wrong_pour");
  EXPECT_EQ(measurement.mistakes[0].sentence,
            "Pour 203 of milk 10 mm, 3 placements from number 209 on, reads 19.4 mm higher than the others of it: "
            "another filling or another cup, and left out.");
  EXPECT_LT(measurement.observations.size(), before);
  for (const Observation& o : measurement.observations) EXPECT_NE(o.factors.pour, 203);
}

TEST(Bookkeeping, APourIsNotLeftOutWhereTheOthersLeaveADoubt) {
  Measurement little = poured_often(3), half = poured_often(2), all = poured_often(3), at_one_place = poured_often(3);
  raise(little, "milk", 10.0, 200, 4.0);            // may be foam, or a careless hand
  raise(half, "milk", 10.0, 100, 20.0);             // which of the two?
  raise(all, "milk", 10.0, 0, 20.0);                // an effect
  for (Observation& o : at_one_place.observations)  // a cup beside its place
    if (o.factors.placement == 209) o.value += 20.0;
  for (Measurement* measurement : {&little, &half, &all, &at_one_place}) {
    put_right(*measurement);
    EXPECT_TRUE(measurement->mistakes.empty());
  }
}

TEST(Bookkeeping, AnEffectIsNoMistake) {
  Measurement measurement = paper_measurement(false);
  const Eigen::VectorXd values =
      Predictor(measurement.rig, measurement.observations).predict(switch_on({{"fill_scale", {0.3}}}));
  for (std::size_t i = 0; i < measurement.observations.size(); ++i)
    measurement.observations[i].value = values[static_cast<Eigen::Index>(i)];
  leave_out_unseen(measurement);
  put_right(measurement);
  EXPECT_TRUE(measurement.mistakes.empty());
}

}  // namespace
}  // namespace fathom
