// Whole simulated frames beside few rays: alike where direct light is all, apart where it is not.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "diagnosis/measurement/cup_regions.h"
#include "diagnosis/ray_traced/traced_evidence.h"
#include "tests/diagnosis/predict/paper_laboratory.h"

namespace fathom {
namespace {

/// One cup with all that its clouds say but what is noise, as few rays predict it, measured twice.
Physics one_condition(const char* liquid, double fill_mm, std::shared_ptr<const UnitBias> unit = {}) {
  Measurement measurement;
  measurement.unit = std::move(unit);
  measurement.rig = paper_laboratory();
  Factors factors = paper_shot(liquid, fill_mm, 300.0);
  const auto add = [&](const char* observable, std::string_view region) {
    Observation& observation = measurement.observations.emplace_back();
    observation.observable = observable;
    observation.factors = factors;
    observation.factors.region = region;
    observation.repeats = 10;
    observation.repeat_sd = 0.1;
  };
  for (factors.placement = 0; factors.placement < 2; ++factors.placement) {
    for (const std::string_view region : kCupRegionNames) add("height_mm", region);
    for (const char* of_desk : {"desk_height_mm", "desk_pitch_deg", "desk_roll_deg"}) add(of_desk, "desk");
    add("log_brightness", kWholeInterior);
  }
  Physics physics = physics_of(measurement);
  for (std::size_t i = 0; i < physics.evidence.observations.size(); ++i)
    physics.evidence.observations[i].value = physics.evidence.predicted[static_cast<Eigen::Index>(i)];
  return physics;
}

RayTracer tracer_of(const Physics& physics) {
  return {physics.predictor, 1, [] {}};
}

TEST(RayTraced, FewRaysMayStandForAHigherSensor) {
  const Physics physics = one_condition("empty", 0.0);
  RayTracer tracer = tracer_of(physics);
  const RayTracedEvidence traced = ray_traced_evidence(physics, {{"sensor_height"}}, tracer);
  ASSERT_EQ(traced.sets.size(), 1u);
  EXPECT_TRUE(traced.sets[0].checks[0].is_fit()) << traced.sets[0].checks[0].cosine;
  EXPECT_EQ(traced.not_seen, 0u);
}

// They see no light that walls throw on; it makes the bottom of the cup brighter.
TEST(RayTraced, FewRaysMayNotStandForLightThatTheyDoNotSee) {
  const Physics physics = one_condition("empty", 0.0);
  RayTracer tracer = tracer_of(physics);
  const RayTracedEvidence traced = ray_traced_evidence(physics, {{"wall_multipath"}}, tracer);
  EXPECT_FALSE(traced.sets[0].checks[0].is_fit());
  const Eigen::VectorXd change = traced.predict({{"wall_multipath", {1.0}}}) - traced.evidence.predicted;
  for (Eigen::Index row = 0; row < change.size(); ++row)
    if (traced.evidence.observations[row].observable == "log_brightness") {
      EXPECT_GT(change[row], 0.02);
    }
  for (const Candidate& candidate : traced.evidence.candidates)
    if (candidate.effect == "wall_multipath") {
      EXPECT_LT((candidate.sensitivity.col(0) - change).norm(), 1e-9);
    }
}

// What is neither traced nor changed by few rays stays where frames have it.
TEST(RayTraced, OtherSetsAreTracedNominallyAndChangedAsFewRaysHaveIt) {
  const Physics physics = one_condition("water", 30.0);
  RayTracer tracer = tracer_of(physics);
  const RayTracedEvidence traced = ray_traced_evidence(physics, {}, tracer);
  const std::vector<EffectValue> fuller{{"fill_offset", {1.0}}};
  const Eigen::VectorXd by_frames = traced.predict(fuller) - traced.evidence.predicted,
                        by_few = physics.predict(fuller) - physics.evidence.predicted;
  ASSERT_EQ(by_frames.size(), by_few.size());
  EXPECT_LT((by_frames - by_few).lpNorm<Eigen::Infinity>(), 1e-9);
  EXPECT_GT(by_few.lpNorm<Eigen::Infinity>(), 0.1);
}

/// What desks say of a unit is taken off whole frames as it is off few rays, and with it what bends the desk.
TEST(RayTraced, WhatTheUnitIsTakenToHaveIsTakenOffFrames) {
  const LaboratoryRig rig = paper_laboratory();
  Factors bare;
  bare.liquid = "none";
  const std::vector<SensedPoint> desk = ray_traced_points(paper_setup(bare, Json::array()), 1);
  Desks desks;
  desks[{}].emplace_back().add(desk, estimate_frame(desk, rig, {})->desk, rig, {});
  const auto change_mm = [](const Physics& physics) {
    RayTracer tracer = tracer_of(physics);
    const std::vector<EffectValue> bent{{"radial_distortion", {0.02}}};
    const Eigen::VectorXd by_frames = tracer.predict(bent) - tracer.predict({}),
                          by_few = physics.predict(bent) - physics.evidence.predicted;
    double frames_mm = 0.0, few_mm = 0.0, regions = 0.0;
    for (Eigen::Index i = 0; i < by_few.size(); ++i)
      if (physics.evidence.observations[i].observable == "height_mm")
        frames_mm += by_frames[i], few_mm += by_few[i], ++regions;
    return std::pair(frames_mm / regions, few_mm / regions);
  };
  const auto [frames_mm, few_mm] = change_mm(one_condition("empty", 0.0, std::make_shared<UnitBias>(desks)));
  const auto [whole_mm, whole_few_mm] = change_mm(one_condition("empty", 0.0));
  EXPECT_NEAR(frames_mm, few_mm, 0.1);
  EXPECT_NEAR(whole_mm, whole_few_mm, 0.1);
  EXPECT_GT(std::abs(whole_mm - frames_mm), 0.4) << "the unit takes nothing off";
}

TEST(RayTraced, ThreadsDoNotMatter) {
  const Physics physics = one_condition("water", 30.0);
  const auto predicted = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    RayTracer tracer = tracer_of(physics);
    return Eigen::VectorXd(tracer.predict({}));
  };
  EXPECT_EQ(predicted(1), predicted(3));
}

// Light comes from below the surface of a liquid that lets it in, so it reads too low; of one that does not it does
// not.
TEST(RayTraced, LightThatEntersALiquidReadsTooLow) {
  const LaboratoryRig rig = paper_laboratory();
  const Factors factors = paper_shot("milk", 30.0, 300.0);
  const Eigen::Vector2d place(0.0, 0.3);
  const auto height_mm = [&](const Json& effects) {
    const auto frame = estimate_frame(ray_traced_points(paper_setup(factors, effects), 1), rig, {place});
    return frame ? mm_from_metres(frame->interior.mean) : NAN;
  };
  const double surface_mm = height_mm(Json::array());
  EXPECT_NEAR(surface_mm, 37.0, 0.3);  // 7 mm of bottom; a matcher's windows hold some of the walls
  const double entered_mm = height_mm({{{"name", "subsurface_scattering"}, {"transport_length_mm", 0.5}}});
  // `fathom reproduce scattering`: 0.3 to 0.4 mm at 1.5 per mm
  EXPECT_NEAR(surface_mm - entered_mm, 0.4, 0.2);
}

}  // namespace
}  // namespace fathom
