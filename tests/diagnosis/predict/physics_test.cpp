// The evidence that a measurement makes, and predictions for it.
#include "diagnosis/predict/physics.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/rng.h"
#include "diagnosis/predict/model_errors.h"
#include "diagnosis/predict/nuisances.h"
#include "diagnosis/predict/predictable.h"
#include "diagnosis/statistics/variance_components.h"
#include "sim/effects/registry.h"
#include "tests/diagnosis/predict/paper_laboratory.h"
#include "tests/diagnosis/predict/paper_measurement.h"

namespace fathom {
namespace {

const Candidate* find(const Evidence& evidence, std::string_view effect) {
  for (const Candidate& candidate : evidence.candidates)
    if (candidate.effect == effect) return &candidate;
  return nullptr;
}

// Processing takes a device's own steps away. Coarser ones it does not make.
TEST(Predictable, StepsCoarserThanTheDevicesCountLikeHeights) {
  std::vector<Observation> observations(3);
  const std::array names{"comb_strength", "comb_quarter", "comb_half"};
  for (std::size_t i = 0; i < observations.size(); ++i) {
    observations[i].observable = names[i];
    observations[i].factors.liquid = "none";
  }
  const std::vector<Observation> kept = predictable(observations);
  ASSERT_EQ(kept.size(), 3U);
  EXPECT_TRUE(kept[0].only_names);
  EXPECT_FALSE(kept[1].only_names);
  EXPECT_FALSE(kept[2].only_names);
}

double cosine(const Eigen::VectorXd& a, const Eigen::VectorXd& b) { return a.dot(b) / (a.norm() * b.norm()); }

/// A bare desk's combs, beside its height.
std::vector<std::string> compared(double steps, double millimetres) {
  std::vector<Observation> observations(3);
  observations[0].observable = "desk_height_mm";
  observations[1].observable = "comb_strength";
  observations[1].value = steps;
  observations[2].observable = "millimetre_comb";
  observations[2].value = millimetres;
  std::vector<std::string> result;
  for (const Observation& o : predictable(observations)) result.push_back(o.observable);
  return result;
}

TEST(Predictable, StepsAreComparedWhereDepthsAreWholeMillimetres) {
  EXPECT_EQ(compared(0.6, 1.0), (std::vector<std::string>{"desk_height_mm", "comb_strength", "millimetre_comb"}));
  // Steps of 1/8 px that nobody cut; no steps at all.
  EXPECT_EQ(compared(-1.0, -0.06), std::vector<std::string>{"desk_height_mm"});
  EXPECT_EQ(compared(0.0, 0.0), std::vector<std::string>{"desk_height_mm"});
}

TEST(Predictable, PlacementsAreRepeatsOfASessionsDesk) {
  std::vector<Observation> observations;
  for (const double roll : {0.1, 0.3, 0.2}) {
    Observation& o = observations.emplace_back();
    o.observable = "desk_roll_deg";
    o.factors.liquid = "water";
    o.factors.placement = static_cast<int>(observations.size());
    o.factors.time_s = 100.0 * o.factors.placement * o.factors.placement;
    o.value = roll;
    o.repeat_sd = 0.001;
    o.repeats = 5;
  }
  observations.push_back(observations.front());
  observations.back().factors.liquid = "none";
  const std::vector<Observation> kept = predictable(observations);
  ASSERT_EQ(kept.size(), 2U);
  EXPECT_NEAR(kept[0].value, 0.2, 1e-12);
  EXPECT_NEAR(kept[0].repeat_sd, 0.1, 1e-12);  // of the placements, a hundred times that of a placement's trials
  EXPECT_EQ(kept[0].repeats, 3);
  EXPECT_EQ(kept[0].factors.time_s, 400.0);  // of 100, 400 and 900 s nearest to their mean
  // One view of the bare desk cannot say how far another would be off. That of the others is taken for it.
  EXPECT_EQ(kept[1].repeats, 1);
  EXPECT_NEAR(repeat_variances(kept)[1], 0.01, 1e-12);
}

TEST(Nuisances, ARecordWithoutBrightnessIsTwoSigmaFromALinearOne) {
  std::vector<Observation> observations(2);
  observations[0].observable = "log_brightness";
  observations[1].observable = "height_mm";
  const Nuisance response = brightness_response(observations, Eigen::Vector2d(-0.4, 16.0));
  EXPECT_DOUBLE_EQ(-0.4 - 2.0 * response.sigma * response.sensitivity[0], 0.0);
  EXPECT_EQ(response.sensitivity[1], 0.0);
}

TEST(Physics, RowsAreWhatTheModelPredicts) {
  const Physics physics = physics_of(paper_measurement(true));
  const Evidence& evidence = physics.evidence;
  ASSERT_EQ(evidence.predicted.size(), static_cast<Eigen::Index>(evidence.observations.size()));
  EXPECT_TRUE(evidence.predicted.allFinite());
  for (const Observation& observation : evidence.observations) EXPECT_NE(observation.observable, "height_sd_mm");
  for (const Candidate& candidate : evidence.candidates) {
    EXPECT_TRUE(candidate.sensitivity.allFinite()) << candidate.effect;
    EXPECT_EQ(candidate.sensitivity.rows(), evidence.predicted.size()) << candidate.effect;
  }
  EXPECT_TRUE(find(evidence, "fill_offset") && find(evidence, "fill_offset@milk"));
  // What shows in water alone is no other effect there.
  ASSERT_TRUE(find(evidence, "refractive_index"));
  EXPECT_FALSE(find(evidence, "refractive_index@water"));
  EXPECT_EQ(find(evidence, "refractive_index")->plausibility, 0.75);  // half for all liquids, a quarter for each of two
  for (const char* unseen : {"depth_wander", "absorption", "wall_albedo", "wall_multipath", "specular_ghost"})
    EXPECT_TRUE(std::count(physics.unseen.begin(), physics.unseen.end(), unseen)) << unseen;
}

TEST(Predictor, SeesTimeWhereEffectsGoByItAndNowhereElse) {
  // The same shot of the same pour at the beginning of a session and after an hour.
  Observation early{.observable = "height_mm", .factors = {.liquid = "water", .region = "centre"}};
  early.factors.fill_mm = 20.0, early.factors.distance_mm = 200.0;
  Observation late = early;
  late.factors.placement = 1, late.factors.time_s = late.factors.stood_s = 3600.0;
  const Predictor predictor(paper_laboratory(), {early, late});
  ASSERT_EQ(predictor.conditions().size(), 2u);
  for (const Effect& effect : effect_registry()) {
    std::vector<double> values;
    for (const EffectParameter& p : effect.parameters) values.push_back(std::min(p.nominal + p.scale, p.upper));
    const Change change = switch_on({{std::string(effect.id), values}});
    const double at_once = predictor.predict(change, {0})[0], after = predictor.predict(change, {1})[1];
    EXPECT_EQ(change.of_time, effect.of_time) << effect.id;
    if (effect.id == "evaporation" || effect.id == "thermal_drift")
      EXPECT_GT(std::abs(after - at_once), 0.01) << effect.id;  // [mm] desk and bottom drift nearly alike
    else
      EXPECT_EQ(after, at_once) << effect.id;
    // All at once is as one by one.
    EXPECT_EQ(predictor.predict(change)[1], after) << effect.id;
  }
}

TEST(ModelErrors, OfADesksHeightGoWithThePartThatIsSeen) {
  // The bias of a part of the image turns the plane that is fitted there, and so lifts it below the camera.
  const Measurement measurement = paper_measurement(true);
  const auto is_by_part = [](const SharedError& error) {
    return error.observable == "desk_height_mm" && std::set(error.group_of.begin(), error.group_of.end()).size() == 5;
  };
  const std::vector<SharedError> errors = model_errors(measurement.observations, measurement.rig);
  const auto found = std::find_if(errors.begin(), errors.end(), is_by_part);
  ASSERT_NE(found, errors.end());  // three places, the bare desk, and other observables
  EXPECT_GT(found->sigma, 0.03);   // [mm]
  EXPECT_LT(found->sigma, 0.3);
}

TEST(Predictor, SeesABareDeskAtItsTime) {
  Observation desk{.observable = "desk_height_mm", .factors = {.liquid = "none", .region = "desk"}};
  desk.factors.time_s = 2000.0;
  // How the desk moves over the session has no time.
  const Observation motion{.observable = "desk_wander_mm", .factors = {.liquid = "none", .region = "desk"}};
  const Predictor predictor(paper_laboratory(), {desk, motion});
  ASSERT_EQ(predictor.conditions().size(), 1u);
  EXPECT_EQ(predictor.conditions()[0].factors.time_s, 2000.0);
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
  for (const char* key : {"height_mm", "pitch_deg", "roll_deg", "baseline_mm", "focal_px", "disparity_offset_px"})
    EXPECT_EQ(named(key), 1) << key;
  for (const Nuisance& nuisance : physics.evidence.nuisances) {
    EXPECT_GT(nuisance.sigma, 0.0) << nuisance.name;
    EXPECT_TRUE(nuisance.sensitivity.allFinite()) << nuisance.name;
  }
}

TEST(Physics, ErrorsOfTheModelAreSharedByRegionsPlacesAndConditions) {
  const Evidence evidence = physics_of(paper_measurement(false)).evidence;
  std::set<int> groups_of_residual, residuals_of_views;
  for (const SharedError& error : evidence.shared_errors) {
    ASSERT_EQ(error.group_of.size(), evidence.observations.size());
    EXPECT_GT(error.sigma, 0.0);
    for (std::size_t i = 0; i < error.group_of.size(); ++i) {
      EXPECT_EQ(error.group_of[i] >= 0, evidence.observations[i].observable == error.observable);
      if (error.observable == "desk_residual_mm")
        (error.of_pixels > 0.0 ? residuals_of_views : groups_of_residual).insert(error.group_of[i]);
    }
  }
  EXPECT_EQ(groups_of_residual.size(), 1u + 9u);  // none, and every third of the image
  EXPECT_GE(residuals_of_views.size(), 1u + 9u);  // of each view for itself
}

TEST(Physics, HolesInAFoamMoveHeightsWhereTheyShowWater) {
  const Evidence evidence = physics_of(paper_measurement(false)).evidence;
  const Eigen::MatrixXd &in_all = find(evidence, "foam")->leeway.columns,
                        &in_water = find(evidence, "foam@water")->leeway.columns;
  for (std::size_t i = 0; i < evidence.observations.size(); ++i) {
    const Observation& o = evidence.observations[i];
    const bool is_of_holes = o.observable == "height_mm" && o.factors.liquid == "water";
    const auto row = static_cast<Eigen::Index>(i);
    EXPECT_EQ(in_all.row(row).isZero(0.0), !is_of_holes) << o.observable << " of " << o.factors.liquid;
    EXPECT_EQ(in_all.row(row), in_water.row(row));
  }
  EXPECT_TRUE(find(evidence, "foam@milk")->leeway.columns.isZero(0.0));
  EXPECT_EQ(find(evidence, "surface_tilt")->leeway.columns.cols(), 0);
}

// Pours of water whose heights differ from shot to shot by what waves do, and those of milk do not.
TEST(Physics, WavesShowInHowHeightsOfClearLiquidsScatter) {
  constexpr int kSessions = 12;
  constexpr double kNoise_mm = 0.05, kWaves_mm = 0.4;
  const std::vector<Observation> once = paper_measurement(false).observations;
  Measurement measurement = paper_measurement(false);
  measurement.observations.clear();
  for (int session = 0; session < kSessions; ++session)
    for (Observation o : once) {
      Rng rng(1, measurement.observations.size());
      o.factors.session = session;
      if (o.observable == "height_mm")
        o.value += rng.normal() * (o.factors.liquid == "water" ? std::hypot(kNoise_mm, kWaves_mm) : kNoise_mm);
      measurement.observations.push_back(std::move(o));
    }
  const Evidence evidence = physics_of(measurement).evidence;
  const auto& all = evidence.observations;
  const auto motion = std::find_if(all.begin(), all.end(), [](const Observation& o) {
    return o.observable == "liquid_motion_mm" && o.factors.liquid == "water";
  });
  ASSERT_NE(motion, all.end());
  EXPECT_NEAR(motion->value / kWaves_mm, 1.0, 0.3);  // three errors of the root of a variance of 54 degrees of freedom
  const Eigen::Index row = motion - all.begin();
  EXPECT_EQ(evidence.predicted[row], 0.0);
  EXPECT_GT(find(evidence, "ripples")->sensitivity(row, 0), 0.0);
  EXPECT_EQ(find(evidence, "refractive_index")->sensitivity(row, 0), 0.0);
}

/// Each height has as error what a matcher's choice among those that stray could make, and no row is lost.
TEST(Physics, HeightsOfWhichManyStrayHardlyCount) {
  Measurement measurement = paper_measurement(false);
  const std::vector<Observation> without_shares = physics_of(measurement).evidence.observations;
  const auto is_height = [](const Observation& o) { return o.observable == "height_mm"; };
  const auto strays = [](const Observation& o) { return o.factors.fill_mm == 30.0 && o.factors.distance_mm == 300.0; };
  std::vector<Observation> shares;
  for (const Observation& o : measurement.observations)
    if (o.observable == "height_mm") {
      shares.push_back(o);
      shares.back().observable = "stray_share";
      shares.back().value = strays(o) ? 0.3 : 0.0;
    }
  measurement.observations.insert(measurement.observations.end(), shares.begin(), shares.end());
  const Evidence evidence = physics_of(measurement).evidence;
  std::size_t of_water = 0;
  for (std::size_t i = 0; i < evidence.observations.size(); ++i) {
    const Observation& o = evidence.observations[i];
    const auto row = static_cast<Eigen::Index>(i);
    if (is_height(o)) {
      EXPECT_NEAR(evidence.numerical_sd[row], strays(o) ? 3.6 : 0.0, 0.01);
    }
    if (o.observable != "stray_share") continue;
    of_water += o.factors.liquid == "water";
    EXPECT_EQ(o.factors.liquid, "water");  // in paint what strays is the matcher's
    EXPECT_NEAR(evidence.predicted[row], 0.0, 1e-9);
    if (strays(o)) {
      EXPECT_GT(find(evidence, "ripples")->sensitivity(row, 0), 0.0);
    }
  }
  EXPECT_EQ(std::ranges::count_if(evidence.observations, is_height), std::ranges::count_if(without_shares, is_height));
  EXPECT_GT(of_water, 0u);
}

TEST(Physics, ThatNothingStraysSaysNothingAgainstWaves) {
  Measurement measurement = paper_measurement(false);
  const std::vector<Observation> all = measurement.observations;
  for (Observation o : all)
    if (o.observable == "height_mm") {
      o.observable = "stray_share";
      o.value = 0.01;
      measurement.observations.push_back(std::move(o));
    }
  for (const Observation& o : physics_of(measurement).evidence.observations) EXPECT_NE(o.observable, "stray_share");
}

/// Heights of clouds are reduced by the program itself.
TEST(Physics, OnlyTablesMayHaveBeenReducedByAClosedForm) {
  const Measurement clouds = paper_measurement(false);
  EXPECT_FALSE(find(physics_of(clouds).evidence, "skew_approximation"));
  Measurement table = clouds;
  std::erase_if(table.observations, [](const Observation& o) { return o.observable != "height_sd_mm"; });
  for (Observation& o : table.observations) o.observable = "height_mm";
  EXPECT_TRUE(find(physics_of(table).evidence, "skew_approximation"));
}

// Trials of one noise, in whole millimetres: where a height is near one, none of them scatters.
TEST(Physics, ScatterBelowWhatHeightsAreRoundedToIsNoMotion) {
  constexpr double kNoise_mm = 0.2;
  Measurement measurement = paper_measurement(false);
  std::erase_if(measurement.observations, [](const Observation& o) { return o.observable != "height_mm"; });
  for (Observation& o : measurement.observations) {
    const double height_mm = o.factors.liquid == "water" ? 12.45 : 12.1;
    double sum = 0.0, squares = 0.0;
    for (int trial = 0; trial < o.repeats; ++trial) {
      Rng rng(1, trial, o.factors.placement);
      const double rounded_mm = std::round(height_mm + kNoise_mm * rng.normal());
      sum += rounded_mm, squares += rounded_mm * rounded_mm;
    }
    o.value = sum / o.repeats;
    o.repeat_sd = std::sqrt((squares - sum * sum / o.repeats) / (o.repeats - 1));
    o.rounding = 1.0 / std::sqrt(12.0);
  }
  for (const Observation& o : physics_of(measurement).evidence.observations) {
    if (o.observable != "liquid_motion_mm") continue;
    EXPECT_LT(std::abs(o.value), 3.0 * o.repeat_sd / std::sqrt(o.repeats)) << o.factors.liquid;
  }
}

TEST(Physics, PredictionsWithoutEffectsAreThePredicted) {
  const Physics physics = physics_of(paper_measurement(true));
  EXPECT_EQ(physics.predict({}), physics.evidence.predicted);
}

/// Clouds of a device's windows and clouds without any lie one error to either side; wider ones go beyond.
TEST(Physics, TheUsualWindowsAreAllowedForAndWiderOnesAreAnEffect) {
  const Physics physics = physics_of(paper_measurement(false));
  const Evidence& evidence = physics.evidence;
  const auto windows = std::find_if(evidence.nuisances.begin(), evidence.nuisances.end(),
                                    [](const Nuisance& nuisance) { return nuisance.name == "matching window"; });
  ASSERT_NE(windows, evidence.nuisances.end());
  const auto in_errors = [&](const Eigen::VectorXd& prediction) {
    return (prediction - evidence.predicted).dot(windows->sensitivity) /
           (windows->sigma * windows->sensitivity.squaredNorm());
  };
  const auto of_width = [&](double px) { return physics.predict({{"window_averaging", {px}}}); };
  EXPECT_NEAR(in_errors(of_width(12.0)), 1.0, 1e-9);
  EXPECT_NEAR(in_errors(physics.predictor->predict({})), -1.0, 1e-9);
  EXPECT_NEAR(in_errors(of_width(1.0)), 0.0, 1e-9) << "which says nothing of windows";
  EXPECT_GT(in_errors(of_width(17.0)), 2.5) << "as the square of the width: 17²/12² of 2, less 1";
  EXPECT_GT(in_errors(of_width(25.0)), 6.0);
  const Candidate* candidate = find(evidence, "window_averaging");
  ASSERT_TRUE(candidate);
  EXPECT_GT(candidate->leeway.columns.cols(), 0);
}

/// A cup in such clouds looks as one does that stands there: 25 mm to the left, and as high.
TEST(Physics, CloudsInTheColourCamerasViewStandBesideTheirPlaces) {
  Measurement measurement = paper_measurement(false);
  for (const char* observable : {"cup_x_mm", "cup_y_mm"}) {
    measurement.observations.push_back(measurement.observations.front());
    measurement.observations.back().observable = observable;
    measurement.observations.back().factors.region = "walls";
  }
  const Physics physics = physics_of(measurement);
  const Eigen::VectorXd change = physics.predict({{"colour_registration", {1.0}}}) - physics.evidence.predicted;
  for (Eigen::Index row = 0; row < change.size(); ++row) {
    const Observation& o = physics.evidence.observations[row];
    if (o.observable.starts_with("desk_")) continue;
    EXPECT_NEAR(change[row], o.observable == "cup_x_mm" ? -25.0 : 0.0, 0.3) << o.observable << ' ' << o.factors.region;
  }
}

TEST(Physics, SensitivitiesAreTheSlopesOfPredictions) {
  const Physics physics = physics_of(paper_measurement(true));
  for (const char* id : {"sensor_height", "baseline", "refractive_index", "fill_scale", "cup_bottom_height"}) {
    const Candidate* candidate = find(physics.evidence, id);
    ASSERT_TRUE(candidate) << id;
    const double half = 0.5 * candidate->parameters[0].prior_scale;
    const Eigen::VectorXd change =
        physics.predict({{id, {candidate->parameters[0].nominal + half}}}) - physics.evidence.predicted;
    // Half a step along a curve that bends by less than a twentieth over a whole one.
    EXPECT_GT(cosine(change, candidate->sensitivity.col(0)), 0.998) << id;
    EXPECT_NEAR(change.norm() / (half * candidate->sensitivity.col(0).norm()), 1.0, 0.05) << id;
  }
}

TEST(Physics, EffectsThatTheSpecCallsAliasedAre) {
  const Evidence evidence = physics_of(paper_measurement(false)).evidence;
  // A bottom that stands higher, and all pours with more in them, where what is poured is opaque: the empty cup alone
  // tells them apart.
  const Eigen::VectorXd bottom = find(evidence, "cup_bottom_height")->sensitivity.col(0),
                        fill = find(evidence, "fill_offset")->sensitivity.col(0);
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
    EXPECT_EQ(all.evidence.candidates[i].sensitivity, alone.evidence.candidates[i].sensitivity);
}

}  // namespace
}  // namespace fathom
