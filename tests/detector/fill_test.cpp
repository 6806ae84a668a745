// Whether a liquid is there and how deep: a test between hypotheses keeps its false alarms and tells what it cannot.
#include "detector/fill.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.h"
#include "core/units.h"

namespace fathom {
namespace {

constexpr Bottom kBottom{0.007, 0.0004};
constexpr double kSigma = 0.0006, kFillMax = 0.068;
constexpr LineOfSight kSight{0.58};

FillDecision decide(double height_m, const ContentSigns& signs = {}) {
  return decide_fill({{height_m, kSigma, kSight}}, kBottom, kFillMax, signs, {});
}

TEST(Fill, ProbabilityRisesWithTheHeight) {
  double before = 0.0;
  for (double height = 0.0070; height < 0.0110; height += 0.0002) {
    const double p = decide(height).p_liquid;
    EXPECT_GE(p, before) << height;
    before = p;
  }
  EXPECT_LT(decide(0.007).p_liquid, 0.05);
  EXPECT_GT(before, 0.99);
}

TEST(Fill, FalseAlarmsOfEmptyCupsAreRareAndShallowFillingsAreSeen) {
  const FillSettings settings;
  Rng rng(1);
  constexpr int kTrials = 2000;
  int alarms = 0, seen = 0, dry = 0, overlooked = 0;
  for (int i = 0; i < kTrials; ++i) {
    const double error = std::hypot(kSigma, kBottom.sigma_m) * rng.normal();
    const double empty = decide(0.007 + error).p_liquid;
    const double water = decide(0.007 + error + apparent_rise(0.010, kSight, 1.33)).p_liquid;
    alarms += empty >= settings.liquid_sure;
    dry += 1.0 - empty >= settings.dry_sure;
    seen += water >= settings.liquid_sure;
    overlooked += 1.0 - water >= settings.dry_sure;
  }
  EXPECT_LE(alarms, 0.01 * kTrials);       // one in 200 is meant, 3 σ of 10 are 19
  EXPECT_GE(seen, 0.95 * kTrials);         // 10 mm of water rise by 4.3 of them
  EXPECT_LE(overlooked, 0.008 * kTrials);  // one in 300 is meant, 3 σ of 7 are 15
  EXPECT_GE(dry, 0.9 * kTrials);           // two in three of what is left are nearer to 10 mm than to nothing
}

TEST(Fill, AWiderErrorOfTheBottomAsksForMore) {
  const std::vector<SurfaceReading> reading{{0.0095, kSigma, kSight}};
  EXPECT_GT(decide_fill(reading, {0.007, 0.0004}, kFillMax, {}, {}).p_liquid, 0.9);
  EXPECT_LT(decide_fill(reading, {0.006, 0.0020}, kFillMax, {}, {}).p_liquid, 0.7);
}

TEST(Fill, LevelsOfBothKindsAreTheirOwnInverse) {
  const double fill = 0.030;
  const FillDecision clear = decide(kBottom.height_m + apparent_rise(fill, kSight, 1.33));
  EXPECT_NEAR(clear.transparent.fill_m, fill, 0.0005);
  const double of_height = std::hypot(kSigma, 0.0004) / apparent_rise(1.0, kSight, 1.33);
  const double of_index = fill * FillSettings{}.index_sigma / (1.33 * 0.33);
  EXPECT_NEAR(clear.transparent.sigma_m, std::hypot(of_height, of_index), 2e-4);
  const FillDecision opaque = decide(kBottom.height_m + fill);
  EXPECT_NEAR(opaque.opaque.fill_m, fill, 0.0005);
  EXPECT_GT(opaque.p_opaque, 0.99);  // no clear filling of this cup raises its bottom by 30 mm
}

TEST(Fill, SeveralViewsTellAClearLiquidFromAnOpaqueOne) {
  const auto p_opaque = [](double rise_near, double rise_far) {
    return decide_fill({{0.007 + rise_near, 0.0004, {0.10}}, {0.007 + rise_far, 0.0004, {0.90}}}, kBottom, kFillMax, {},
                       {})
        .p_opaque;
  };
  EXPECT_LT(p_opaque(apparent_rise(0.04, {0.10}, 1.33), apparent_rise(0.04, {0.90}, 1.33)), 0.01);
  EXPECT_GT(p_opaque(0.012, 0.012), 0.9);
}

/// How many of 2,000 random fillings lie within 1.96 σ of what is told, when readings of all views share the bottom's
/// error and have errors of their own.
double covered_share(bool opaque, const std::vector<LineOfSight>& views, double sigma_m, double index_sigma) {
  Rng rng(7);
  constexpr int kTrials = 2000;
  const FillSettings settings;
  int covered = 0;
  for (int i = 0; i < kTrials; ++i) {
    const double fill = settings.fill_min_m + (kFillMax - settings.fill_min_m) * rng.uniform();
    const double bottom = kBottom.height_m + kBottom.sigma_m * rng.normal();
    const double index = settings.index + index_sigma * rng.normal();
    std::vector<SurfaceReading> readings;
    for (const LineOfSight& view : views) {
      const double rise = opaque ? fill : apparent_rise(fill, view, index);
      readings.push_back({bottom + rise + sigma_m * rng.normal(), sigma_m, view});
    }
    const FillDecision decision = decide_fill(readings, kBottom, kFillMax, {}, settings);
    const FillDecision::Level& level = opaque ? decision.opaque : decision.transparent;
    covered += std::abs(level.fill_m - fill) <= 1.96 * level.sigma_m;
  }
  return static_cast<double>(covered) / kTrials;
}

TEST(Fill, ItsErrorCoversAsMuchAsItSays) {
  constexpr double kWithin = 0.02;  // 4 σ of 2,000 trials; fills at the rim and the least have lopsided errors
  const std::vector<LineOfSight> one{kSight}, three{{0.35}, {0.6, 0.2}, {0.8}};
  for (const auto& views : {one, three})
    for (const double sigma : {0.0001, 0.0006}) {
      EXPECT_NEAR(covered_share(true, views, sigma, 0.0), 0.95, kWithin) << views.size() << " " << sigma;
      EXPECT_NEAR(covered_share(false, views, sigma, FillSettings{}.index_sigma), 0.95, kWithin)
          << views.size() << " " << sigma;
    }
}

TEST(Fill, SignsDecideWhereNoHeightIsSeen) {
  const auto p = [](double opaque) {
    return decide_fill({}, kBottom, kFillMax, {opaque, std::nullopt, "washed out"}, {});
  };
  EXPECT_NEAR(p(1.0).p_liquid, 0.5, 1e-12);
  EXPECT_GT(p(20.0).p_liquid, 0.9);
  EXPECT_GT(p(20.0).p_opaque, 0.9);
}

TEST(Fill, ADimBottomSpeaksForAClearLiquidAndABrightOneAgainst) {
  const double rise = apparent_rise(0.030, kSight, 1.33);
  const auto p_opaque = [&](double brightness) { return decide(0.007 + rise, {1.0, brightness, "seen"}).p_opaque; };
  EXPECT_LT(p_opaque(0.42), 0.1);
  EXPECT_GT(p_opaque(0.90), 0.7);
}

TEST(Fill, AHeightBelowTheBottomIsNoLiquid) { EXPECT_LT(decide(0.005).p_liquid, 0.05); }

}  // namespace
}  // namespace fathom
