// The evidence that a measurement makes, and predictions for it.
#include "diagnosis/predict/physics.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "diagnosis/measurement/named_values.h"
#include "tests/diagnosis/predict/paper_laboratory.h"

namespace fathom {
namespace {

/// Observations of everything that clouds of a campaign would give, without values.
Measurement paper_measurement(bool bare_desk) {
  Measurement measurement;
  measurement.rig = paper_laboratory();
  int pour = 0, placement = 0;
  const auto add = [&](const Factors& factors, const char* observable, std::string_view region) {
    Observation& observation = measurement.observations.emplace_back();
    observation.observable = observable;
    observation.factors = factors;
    observation.factors.region = region;
    observation.repeats = 10;
  };
  const auto add_desk = [&](const Factors& factors) {
    for (const char* observable : {"desk_height_mm", "desk_pitch_deg", "desk_roll_deg"})
      add(factors, observable, "desk");
    for (const std::string_view region : kDeskRegionNames) add(factors, "desk_residual_mm", region);
  };
  Factors factors;
  factors.liquid = "none";
  if (bare_desk) add_desk(factors);
  for (const auto& [liquid, fill_mm] :
       {std::pair{"empty", 0.0}, {"water", 10.0}, {"water", 30.0}, {"milk", 10.0}, {"milk", 30.0}}) {
    for (const double distance_mm : {200.0, 300.0, 400.0}) {
      factors.liquid = liquid;
      factors.fill_mm = fill_mm;
      factors.distance_mm = distance_mm;
      factors.pour = pour;
      factors.placement = placement++;
      factors.time_s = 10.0 * factors.placement;
      for (const std::string_view region : kCupRegionNames) add(factors, "height_mm", region);
      add(factors, "height_sd_mm", kWholeInterior);
      add_desk(factors);
    }
    ++pour;
  }
  return measurement;
}

const Candidate* find(const Evidence& evidence, std::string_view effect) {
  for (const Candidate& candidate : evidence.candidates)
    if (candidate.effect == effect) return &candidate;
  return nullptr;
}

double cosine(const Eigen::VectorXd& a, const Eigen::VectorXd& b) { return a.dot(b) / (a.norm() * b.norm()); }

TEST(Physics, RowsAreWhatTheModelPredicts) {
  const Physics physics = physics_of(paper_measurement(true));
  const Evidence& evidence = physics.evidence;
  ASSERT_EQ(evidence.predicted.size(), static_cast<Eigen::Index>(evidence.observations.size()));
  EXPECT_TRUE(evidence.predicted.allFinite());
  for (const Observation& observation : evidence.observations) EXPECT_NE(observation.observable, "height_sd_mm");
  for (const Candidate& candidate : evidence.candidates) {
    EXPECT_TRUE(candidate.signature.allFinite()) << candidate.effect;
    EXPECT_EQ(candidate.signature.rows(), evidence.predicted.size()) << candidate.effect;
  }
  EXPECT_TRUE(find(evidence, "fill_offset") && find(evidence, "fill_offset@milk"));
  for (const char* unseen : {"depth_wander", "absorption", "wall_albedo", "wall_multipath", "specular_ghost"})
    EXPECT_TRUE(std::count(physics.unseen.begin(), physics.unseen.end(), unseen)) << unseen;
}

TEST(Physics, NuisancesAreOnePerPourPlacementAndUncertainValue) {
  const Physics physics = physics_of(paper_measurement(false));
  const auto named = [&](const char* start) {
    return std::count_if(physics.evidence.nuisances.begin(), physics.evidence.nuisances.end(),
                         [&](const Nuisance& nuisance) { return nuisance.name.rfind(start, 0) == 0; });
  };
  EXPECT_EQ(named("fill of pour "), 4);
  EXPECT_EQ(named("x of placement "), 15);
  EXPECT_EQ(named("y of placement "), 15);
  EXPECT_EQ(named("model of desk_residual_mm, "), 9 + 9);  // of every third of the image, always and in the session
  // Of each filling the far sector at least: the others lie in the wall's shadow where the cup is deep.
  EXPECT_GE(named("model of height_mm, "), 3);
  for (const char* key : {"height_mm", "pitch_deg", "roll_deg", "baseline_mm", "focal_px", "disparity_offset_px"})
    EXPECT_EQ(named(key), 1) << key;
  for (const Nuisance& nuisance : physics.evidence.nuisances) {
    EXPECT_GT(nuisance.sigma, 0.0) << nuisance.name;
    EXPECT_TRUE(nuisance.signature.allFinite()) << nuisance.name;
  }
}

TEST(Physics, PredictionsWithoutEffectsAreThePredicted) {
  const Physics physics = physics_of(paper_measurement(true));
  EXPECT_EQ(physics.predict({}), physics.evidence.predicted);
}

TEST(Physics, SignaturesAreTheSlopesOfPredictions) {
  const Physics physics = physics_of(paper_measurement(true));
  for (const char* id : {"sensor_height", "baseline", "refractive_index", "fill_scale", "cup_bottom_height"}) {
    const Candidate* candidate = find(physics.evidence, id);
    ASSERT_TRUE(candidate) << id;
    const double half = 0.5 * candidate->parameters[0].prior_scale;
    const Eigen::VectorXd change =
        physics.predict({{id, {candidate->parameters[0].nominal + half}}}) - physics.evidence.predicted;
    // Half a step along a curve that bends by less than a twentieth over a whole one.
    EXPECT_GT(cosine(change, candidate->signature.col(0)), 0.998) << id;
    EXPECT_NEAR(change.norm() / (half * candidate->signature.col(0).norm()), 1.0, 0.05) << id;
  }
}

TEST(Physics, TwinsOfTheSpecAreTwins) {
  const Evidence evidence = physics_of(paper_measurement(false)).evidence;
  // A bottom that stands higher, and all pours with more in them, where what is poured is opaque: the empty cup alone
  // tells them apart.
  const Eigen::VectorXd bottom = find(evidence, "cup_bottom_height")->signature.col(0),
                        fill = find(evidence, "fill_offset")->signature.col(0);
  Eigen::VectorXd bottom_of_milk = bottom, fill_of_milk = fill;
  for (Eigen::Index row = 0; row < bottom.size(); ++row)
    if (evidence.observations[row].factors.liquid != "milk") bottom_of_milk[row] = fill_of_milk[row] = 0.0;
  EXPECT_GT(cosine(bottom_of_milk, fill_of_milk), 0.9999);
  EXPECT_LT(cosine(bottom, fill), 0.9);
}

TEST(Physics, IsTheSameForAnyNumberOfThreads) {
  const Measurement measurement = paper_measurement(true);
  const Physics all = physics_of(measurement);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Physics alone = physics_of(measurement);
  ASSERT_EQ(all.evidence.candidates.size(), alone.evidence.candidates.size());
  for (std::size_t i = 0; i < all.evidence.candidates.size(); ++i)
    EXPECT_EQ(all.evidence.candidates[i].signature, alone.evidence.candidates[i].signature);
}

}  // namespace
}  // namespace fathom
