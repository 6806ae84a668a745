// What could be measured next: what plans hold, and what the model expects of them.
#include "diagnosis/predict/designs.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/diagnosis/predict/paper_laboratory.h"

namespace fathom {
namespace {

void add_observation(const char* observable, const char* region, double distance_mm, Measurement& measurement) {
  Observation& observation = measurement.observations.emplace_back();
  observation.observable = observable;
  observation.factors = {.liquid = "milk", .fill_mm = 20.0, .distance_mm = distance_mm, .region = region};
}

/// Milk at two distances, 20 mm deep; to plan it is enough to know of what kinds its observations are, and where.
Measurement milk_alone() {
  Measurement measurement;
  measurement.rig = paper_laboratory();
  measurement.rig.liquids.erase("water");
  for (const double distance_mm : {200.0, 300.0}) {
    for (const char* region : {"centre", "near", "far", "left", "right"})
      add_observation("height_mm", region, distance_mm, measurement);
    for (const char* of_desk : {"desk_height_mm", "desk_pitch_deg", "desk_roll_deg"})
      add_observation(of_desk, "desk", distance_mm, measurement);
  }
  return measurement;
}

const MeasurementPlan* find(const std::vector<MeasurementPlan>& plans, const std::string& part) {
  const auto found = std::find_if(plans.begin(), plans.end(), [&](const MeasurementPlan& plan) {
    return plan.name.find(part) != std::string::npos;
  });
  return found == plans.end() ? nullptr : &*found;
}

TEST(Designs, PlanWhatWasNotMeasuredYet) {
  const std::vector<MeasurementPlan> plans = possible_plans(milk_alone());
  for (const char* part : {"bare-desk", "empty cup", "milk 10 and 60 mm deep", "laterals", "clear water"})
    EXPECT_NE(find(plans, part), nullptr) << part;
  EXPECT_EQ(find(plans, "opaque"), nullptr);  // milk is
  const MeasurementPlan* distances = find(plans, "distances");
  ASSERT_NE(distances, nullptr);
  EXPECT_EQ(distances->distances_mm, (std::vector{400.0, 500.0}));
  EXPECT_LT(find(plans, "bare-desk")->minutes(), find(plans, "clear water")->minutes());
}

TEST(Designs, ClearWaterIsNewWhereItWasOnlyKnown) {
  Measurement measurement = milk_alone();
  measurement.rig.liquids["water"] = Json("water");
  EXPECT_NE(find(possible_plans(measurement), "clear water"), nullptr);
  measurement.observations.back().factors.liquid = "water";
  EXPECT_EQ(find(possible_plans(measurement), "clear water"), nullptr);
}

TEST(Designs, WhoWroteDownHeightsOnlyWillDoSoAgain) {
  Measurement measurement = milk_alone();
  measurement.observations.clear();
  for (const double distance_mm : {200.0, 300.0}) add_observation("height_mm", "interior", distance_mm, measurement);
  const std::vector<MeasurementPlan> plans = possible_plans(measurement);
  EXPECT_TRUE(design_of(*find(plans, "bare-desk"), measurement, {"sensor_height"}).evidence.observations.empty());
  const Design empty = design_of(*find(plans, "empty cup"), measurement, {"cup_bottom_height", "cup_placement"});
  ASSERT_EQ(empty.evidence.observations.size(), 4u);  // two distances, put down twice
  for (const Observation& observation : empty.evidence.observations) {
    EXPECT_EQ(observation.observable, "height_mm");
    EXPECT_EQ(observation.factors.region, "interior");
  }
}

TEST(Designs, TheBareDeskShowsTheSensorAndNoCup) {
  const Measurement measurement = milk_alone();
  const Design design = design_of(*find(possible_plans(measurement), "bare-desk"), measurement,
                                  {"sensor_height", "cup_bottom_height", "fill_offset"});
  ASSERT_FALSE(design.evidence.observations.empty());
  for (const Observation& observation : design.evidence.observations) {
    EXPECT_NE(observation.observable, "height_mm");
    EXPECT_EQ(observation.factors.session, 1);  // after the one that there is
  }
  ASSERT_EQ(design.evidence.candidates.size(), 1u);
  EXPECT_EQ(design.evidence.candidates[0].effect, "sensor_height");
  // For it the sensor is set up anew, as it will not quite stand again.
  EXPECT_TRUE(std::any_of(design.evidence.nuisances.begin(), design.evidence.nuisances.end(),
                          [](const Nuisance& nuisance) { return nuisance.name == "height_mm of session 1"; }));
}

TEST(Designs, TheEmptyCupShowsItsBottomAndNoFill) {
  const Measurement measurement = milk_alone();
  const Design design =
      design_of(*find(possible_plans(measurement), "empty cup"), measurement, {"cup_bottom_height", "fill_offset"});
  ASSERT_EQ(design.evidence.candidates.size(), 1u);
  const Candidate& bottom = design.evidence.candidates[0];
  EXPECT_EQ(bottom.effect, "cup_bottom_height");
  for (std::size_t row = 0; row < design.evidence.observations.size(); ++row) {
    if (design.evidence.observations[row].observable != "height_mm") continue;
    // A bottom that is a millimetre higher reads so, but for the device's step of a millimetre over few rays.
    EXPECT_NEAR(bottom.sensitivity(static_cast<Eigen::Index>(row), 0), 1.0, 0.2) << row;
  }
}

}  // namespace
}  // namespace fathom
