// The errors that the data show: components found again, tails as thick as they are known.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.h"
#include "diagnosis/statistics/box_least_squares.h"
#include "diagnosis/statistics/covariance.h"
#include "diagnosis/statistics/distributions.h"
#include "diagnosis/statistics/strata.h"
#include "tests/diagnosis/statistics/small_campaign.h"

namespace fathom {
namespace {

TEST(Distributions, AgreeWithPrintedTables) {
  // Abramowitz & Stegun 1964, tables 26.5, 26.7, 26.9 and 26.10, to the digits printed.
  EXPECT_NEAR(normal_tail(1.959964), 0.025, 1e-7);
  EXPECT_NEAR(normal_quantile(0.001), 3.09023, 1e-5);
  EXPECT_NEAR(chi_squared_tail(18.307, 10.0), 0.05, 1e-5);
  EXPECT_NEAR(student_quantile(0.025, 5.0), 2.571, 5e-4);
}

TEST(NormalScore, HasTheTailOfStudentsT) {
  for (const double dof : {5.0, 10.0, 50.0})
    for (const double z : {1.0, 2.0, 3.0, 4.0, 5.0})
      if (const double t = student_quantile(normal_tail(z), dof); t < 6.0) {
        EXPECT_NEAR(normal_score(t, dof), z, 0.03);
      }
}

TEST(VarianceComponents, AreFoundAgain) {
  CampaignDesign design = small_design();
  design.pours = 8;  // what is stated of fills hides how two differ
  const World world(design);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  constexpr int kSets = 40;
  for (int set = 0; set < kSets; ++set) {
    const Evidence evidence = world.measure({}, {}, 300 + set);
    const Covariance covariance = estimate_covariance(evidence, residual_of(evidence));
    for (const ObservableErrors& errors : covariance.errors.observables)
      for (const VarianceComponent& component : errors.components)
        if (component.observable == "height_mm" && component.level != ErrorLevel::session)
          mean[static_cast<int>(component.level)] += component.variance / kSets;
  }
  // 0.10, 0.12 and 0.08 mm (synthetic_campaign.cpp). The means of 40 estimates with a hundred degrees of freedom
  // and more scatter by 2 %, that of pours with 28, beside stated fills, by 15 % and is pushed up by estimates that
  // stop at 0.
  EXPECT_NEAR(mean[0], 0.10 * 0.10, 0.2 * 0.10 * 0.10);
  EXPECT_NEAR(mean[1], 0.12 * 0.12, 0.2 * 0.12 * 0.12);
  EXPECT_NEAR(mean[2], 0.08 * 0.08, 0.5 * 0.08 * 0.08);
}

TEST(VarianceComponents, OfPoursThatWereNotRepeatedAreFoundBetweenThem) {
  const World world(once_poured_design());
  constexpr double kPours = 0.4;  // mm
  double mean = 0.0;
  constexpr int kSets = 20;
  for (int set = 0; set < kSets; ++set) {
    const Evidence evidence = with_errors_of_pours(world.measure({}, {}, 300 + set), kPours, 900 + set);
    const Covariance covariance = estimate_covariance(evidence, residual_of(evidence));
    ASSERT_TRUE(covariance.errors.from_replicates);
    for (const VarianceComponent& component : covariance.errors.observables.front().components)
      if (component.level == ErrorLevel::pour) mean += component.variance / kSets;
  }
  // Candidates leave some eight of 17 pours: each estimate scatters by half, the mean of twenty by a ninth: three times
  // that allowed.
  EXPECT_NEAR(mean, kPours * kPours + 0.08 * 0.08, 0.35 * kPours * kPours);
}

TEST(VarianceComponents, AreNoLargerThanTheLaboratoryStates) {
  const World world(once_poured_design());
  constexpr double kStated_mm = 0.2;
  Evidence evidence = with_errors_of_pours(world.measure({}, {}, 300), 2.0, 900);
  evidence.stated.fill_mm = kStated_mm;
  const Covariance covariance = estimate_covariance(evidence, residual_of(evidence));
  int pours = 0;
  for (const VarianceComponent& component : covariance.errors.observables.front().components) {
    if (component.level != ErrorLevel::pour) continue;
    ++pours;
    EXPECT_DOUBLE_EQ(component.variance, kStated_mm * kStated_mm);
    EXPECT_GT(component.found.value, kStated_mm * kStated_mm);
  }
  EXPECT_EQ(pours, 1);
}

TEST(VarianceComponents, DoNotChangeWithAnEffectThatNothingSees) {
  const World world(once_poured_design());
  Evidence evidence = with_errors_of_pours(world.measure({}, {}, 300), 0.4, 900);
  const Eigen::MatrixXd before = estimate_covariance(evidence, residual_of(evidence)).total;
  Candidate unseen = evidence.candidates.front();
  unseen.sensitivity.setZero();
  evidence.candidates.push_back(unseen);
  const Eigen::MatrixXd after = estimate_covariance(evidence, residual_of(evidence)).total;
  EXPECT_LT((after - before).norm(), 1e-9 * before.norm());
}

TEST(VarianceComponents, AreFoundWithoutAnyCandidate) {
  const World world(once_poured_design());
  Evidence evidence = with_errors_of_pours(world.measure({}, {}, 300), 0.4, 900);
  evidence.candidates.clear();
  EXPECT_TRUE(estimate_covariance(evidence, residual_of(evidence)).total.allFinite());
}

TEST(VarianceComponents, NothingThatIsPouredMovesTheDesk) {
  const World world(small_design());
  const Evidence evidence = world.measure({}, {}, 300);
  bool has_desk = false;
  for (const ObservableErrors& errors : estimate_covariance(evidence, residual_of(evidence)).errors.observables)
    for (const VarianceComponent& component : errors.components) {
      if (!component.observable.starts_with("desk_")) continue;
      has_desk = true;
      EXPECT_NE(component.level, ErrorLevel::pour);
    }
  EXPECT_TRUE(has_desk);
}

TEST(VarianceComponents, AreBlindToEffects) {
  const World world(small_design());
  const EffectValue effect = world.at_strength("radial_distortion", 50.0, 1.0);
  const Evidence with = world.measure({effect}, {}, 5), without = world.measure({}, {}, 5);
  const Covariance a = estimate_covariance(with, residual_of(with)),
                   b = estimate_covariance(without, residual_of(without));
  // Equal conditions change equally: nothing but rounding may differ.
  EXPECT_LT((a.total - b.total).norm(), 1e-6 * b.total.norm());
}

/// A mean over a session's placements stands at the place of one of them, and is of no liquid, fill or place.
TEST(Groups, SessionsAreRepeatsOfTheirMeans) {
  std::vector<Observation> observations(2);
  for (Observation& o : observations) o.observable = "desk_roll_deg", o.is_of_session = true;
  observations[0].factors = {.session = 0, .liquid = "milk", .fill_mm = 20.0, .distance_mm = 300.0, .region = "desk"};
  observations[1].factors = {.session = 1, .liquid = "water", .fill_mm = 30.0, .distance_mm = 200.0, .region = "desk"};
  EXPECT_EQ(cell_key(observations[0]), cell_key(observations[1]));
  std::vector<std::string> names;
  for (const Stratum& stratum : list_strata(observations)) names.push_back(stratum.name);
  EXPECT_EQ(names, (std::vector<std::string>{"all", "session=0", "session=1"}));
}

/// Two views of it in one session show the same dots at the same places: they are no two samples of how placements
/// scatter.
TEST(Groups, ABareDeskIsPutDownOncePerSession) {
  std::vector<Observation> views(3);
  for (Observation& view : views) view.factors.liquid = "none";
  views[1].factors.placement = 1;
  views[2].factors.session = 1;
  EXPECT_EQ(placement_key(views[0]), placement_key(views[1]));
  EXPECT_NE(placement_key(views[0]), placement_key(views[2]));
}

TEST(BoxLeastSquares, FindsTheMinimumWhereFreeEffectsAreNearlyAlike) {
  // Two effects 2 degrees apart, and a third that its bound holds.
  Eigen::Matrix3d X;
  X << 100.0, 100.0 * std::cos(0.035), 60.0, 0.0, 100.0 * std::sin(0.035), 50.0, 0.0, 0.0, 40.0;
  const Eigen::Matrix3d G = X.transpose() * X;
  const Eigen::Vector3d b = G * Eigen::Vector3d(2.0, -1.5, 1.5), lower(-10.0, -10.0, -1.0), upper(10.0, 10.0, 1.0);
  const Eigen::Vector3d x = box_least_squares(G, b, lower, upper);
  EXPECT_EQ(x[2], 1.0);
  EXPECT_LT((b - G * x).head<2>().norm(), 1e-6 * b.norm());
}

TEST(Groups, KeepPoursApartThatAreNumberedAnewForEachFilling) {
  Observation shallow, deep;
  shallow.factors.liquid = deep.factors.liquid = "water";
  shallow.factors.pour = deep.factors.pour = 1;
  shallow.factors.fill_mm = 10.0;
  deep.factors.fill_mm = 30.0;
  EXPECT_NE(pour_key(shallow), pour_key(deep));
}

/// Poured and put down once, all fillings read alike at a place: a smear on the lens is no scatter of placements.
TEST(VarianceComponents, AreBlindToWhatAllFillingsShowAtAPlace) {
  CampaignDesign design;
  design.pours = design.sessions = 1;
  const World world(design);
  const Evidence clean = world.measure({}, {}, 5);
  Evidence smeared = clean;
  const Groups places = group_by(clean.observations, [](const Observation& o) {
    return fmt::format("{} {} {}", o.factors.distance_mm, o.factors.lateral_mm, o.factors.region);
  });
  for (std::size_t i = 0; i < smeared.observations.size(); ++i)
    if (smeared.observations[i].observable == "height_mm")
      smeared.observations[i].value += 0.5 * Rng(11, places.of[i]).normal();
  const Covariance a = estimate_covariance(smeared, residual_of(smeared)),
                   b = estimate_covariance(clean, residual_of(clean));
  ASSERT_FALSE(a.errors.from_replicates);
  EXPECT_LT((a.total - b.total).norm(), 1e-6 * b.total.norm());
}

/// A campaign in which the heights of each condition are off together by an error of the model.
Evidence with_error_of_conditions(const World& world, double sd, double thought, int set) {
  Evidence evidence = world.measure({}, {}, 700 + set);
  const Groups conditions = group_by(evidence.observations, [](const Observation& o) {
    return o.observable == "height_mm" ? condition_key(o) : std::string();
  });
  std::vector<double> errors;
  for (int k = 0; k < conditions.count; ++k) errors.push_back(sd * Rng(800 + set, k).normal());
  for (std::size_t i = 0; i < evidence.observations.size(); ++i)
    if (conditions.of[i] >= 0) evidence.observations[i].value += errors[conditions.of[i]];
  evidence.shared_errors.push_back({"height_mm", conditions.of, thought});
  return evidence;
}

double shared_variance(const Evidence& evidence) {
  const Covariance covariance = estimate_covariance(evidence, residual_of(evidence));
  for (const ObservableErrors& errors : covariance.errors.observables)
    for (const VarianceComponent& component : errors.components)
      if (component.level == ErrorLevel::model) return component.variance;
  return 0.0;
}

TEST(SharedErrors, AreAsLargeAsTheDataShowAndAtMostTwiceAsLargeAsThought) {
  const World world;
  constexpr int kSets = 8;
  double large = 0.0, too_large = 0.0, none = 0.0;
  for (int set = 0; set < kSets; ++set) {
    large += shared_variance(with_error_of_conditions(world, 0.4, 0.25, set)) / kSets;
    too_large += shared_variance(with_error_of_conditions(world, 0.4, 0.05, set)) / kSets;
    none += shared_variance(with_error_of_conditions(world, 0.0, 0.2, set)) / kSets;
  }
  // 63 conditions, of which the candidates leave half: each variance scatters by a quarter, the mean of eight by a
  // tenth; the ten degrees of freedom of what was thought pull by a quarter as well.
  EXPECT_NEAR(std::sqrt(large), 0.4, 0.1);
  EXPECT_NEAR(std::sqrt(too_large), 0.1, 1e-9);
  EXPECT_LT(std::sqrt(none), 0.15) << "errors that are not there are believed less than they were thought";
}

TEST(SharedErrors, AreBlindToCandidates) {
  const World world;
  const Evidence without = with_error_of_conditions(world, 0.2, 0.05, 1);
  Evidence with = without;
  const Candidate& candidate = with.candidates[world.candidate("radial_distortion")];
  for (std::size_t i = 0; i < with.observations.size(); ++i)
    with.observations[i].value +=
        20.0 * candidate.parameters[0].prior_scale * candidate.sensitivity(static_cast<Eigen::Index>(i), 0);
  EXPECT_NEAR(shared_variance(with) / shared_variance(without), 1.0,
              1e-3);  // rounding, through thirty steps of scoring
}

/// A campaign whose every mean is of few pixels has larger errors than one of many, and not only beside its own.
TEST(SharedErrors, AreOfSoManyPixelsInEveryCampaign) {
  const auto observed = [](std::initializer_list<double> pixels) {
    std::vector<Observation> observations;
    for (const double each : pixels) {
      observations.emplace_back().observable = "cup_radius_mm";
      observations.back().pixels = each;
    }
    return observations;
  };
  EXPECT_EQ(errors_of_means(observed({100.0, 100.0}), 400.0), Eigen::Vector2d(2.0, 2.0));
  EXPECT_EQ(errors_of_means(observed({1600.0, 1600.0}), 400.0), Eigen::Vector2d(0.5, 0.5));
  EXPECT_EQ(errors_of_means(observed({400.0, 400.0, 4.0}), 400.0), Eigen::Vector3d(1.0, 1.0, 3.0));
  EXPECT_EQ(errors_of_means(observed({0.0, 0.0}), 400.0), Eigen::Vector2d(1.0, 1.0)) << "of no certain number";
}

TEST(Covariance, WhitensWhatItIsTheCovarianceOf) {
  const World world(small_design());
  double mean = 0.0;
  constexpr int kSets = 20;
  for (int set = 0; set < kSets; ++set) {
    const Evidence evidence = world.measure({}, {}, 500 + set);
    const Covariance covariance = estimate_covariance(evidence, residual_of(evidence));
    mean += covariance.whiten(residual_of(evidence)).squaredNorm() /
            (kSets * static_cast<double>(residual_of(evidence).size()));
  }
  // χ² per observation; 20 × 280 numbers scatter by 2 %, uncertain components add as much.
  EXPECT_NEAR(mean, 1.0, 0.1);
}

/// Of 30 placements half a region's errors are of 100 pixels, half of 900: they go with 1/√pixels, and a thing that
/// both show is known by the errors of the latter.
TEST(VarianceComponents, GoWithTheNumberOfPixels) {
  constexpr double kSigma_mm = 0.3;  // of 100 pixels
  constexpr int kSets = 40, kPlacements = 60;
  double of_few = 0.0, of_many = 0.0;
  for (int set = 0; set < kSets; ++set) {
    Rng rng(set, 77);
    Evidence evidence;
    for (int placement = 0; placement < kPlacements; ++placement) {
      Observation o;
      o.observable = "height_mm";
      o.factors.placement = placement;
      o.factors.region = placement % 2 == 0 ? "near" : "far";
      o.pixels = placement % 2 == 0 ? 100.0 : 900.0;
      o.value = kSigma_mm * std::sqrt(100.0 / o.pixels) * rng.normal();
      evidence.observations.push_back(std::move(o));
    }
    evidence.predicted = Eigen::VectorXd::Zero(kPlacements);
    const Covariance covariance = estimate_covariance(evidence, residual_of(evidence));
    of_few += covariance.total(0, 0) / kSets;
    of_many += covariance.total(1, 1) / kSets;
  }
  // 29 degrees of freedom count for either size, 58 together, in 40 sets: 3 % of a variance, three times that allowed.
  EXPECT_NEAR(of_few / (kSigma_mm * kSigma_mm), 1.0, 0.1);
  EXPECT_NEAR(of_few / of_many, 9.0, 0.1);
}

TEST(RepeatVariances, PoolWithoutOutliers) {
  constexpr double kVariance = 0.2 * 0.2 / 10.0;  // of the mean of ten repeats that scatter by 0.2 mm
  std::vector<Observation> observations(9, {"height_mm", {}, 0.0, 0.2, 10});
  EXPECT_NEAR(repeat_variances(observations)[0], kVariance, 1e-12 * kVariance);  // rounding
  observations[4].repeat_sd = 20.0;
  const Eigen::VectorXd variances = repeat_variances(observations);
  // One's own scatter beside that of all, in which one of nine counts three times its size: (8 + 9) / 9 of the
  // variance.
  EXPECT_GT(variances[0], kVariance);
  EXPECT_LT(variances[0], kVariance * 17.0 / 9.0);
  EXPECT_GT(variances[4], 100.0 * variances[0]);
}

}  // namespace
}  // namespace fathom
