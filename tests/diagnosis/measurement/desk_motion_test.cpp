// What frames of a bare desk tell of how it moves between them.
#include "diagnosis/measurement/desk_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/rng.h"
#include "core/units.h"
#include "diagnosis/measurement/named_values.h"
#include "tests/diagnosis/measurement/tilted_desk.h"

namespace fathom {
namespace desk_motion_test {

const LaboratoryRig kRig = laboratory();

/// Amplitudes of what changes from frame to frame, in disparity [px]; waves of 180 rows or columns, of any phase.
struct Motion {
  double noise = 0.0, all = 0.0, along_rows = 0.0, along_columns = 0.0;
  double shear = 0.0;      ///< between the middle row and the last
  double pitch_deg = 0.0;  ///< of the sensor, 1 σ
};

/// Every fourth pixel of a desk whose disparities differ by that from the true ones.
std::vector<SensedPoint> desk_frame(const Motion& motion, Rng& rng) {
  LaboratoryRig trembling = kRig;
  if (motion.pitch_deg > 0.0) trembling.pitch_rad += radians_from_deg(motion.pitch_deg) * rng.normal();
  const double all = motion.all * rng.normal(), shear = motion.shear > 0.0 ? motion.shear * rng.normal() : 0.0;
  const double phase = 2.0 * std::numbers::pi * rng.uniform();
  const auto wave = [&](double at) { return std::sin(2.0 * std::numbers::pi * at / 180.0 + phase); };
  return desk_points(trembling, 4.0, [&](double column, double row, double) {
    return motion.noise * rng.normal() + all + motion.along_rows * wave(row) + motion.along_columns * wave(column) +
           shear * (row / 240.0 - 1.0);
  });
}

double deviation(const std::vector<double>& values) {
  double sum = 0.0, squares = 0.0;
  for (const double value : values) sum += value, squares += value * value;
  const auto n = static_cast<double>(values.size());
  return std::sqrt(std::max(0.0, (squares - sum * sum / n) / (n - 1.0)));
}

/// Twelve placements of five frames each, as read_measurement() has them.
std::vector<Observation> observations_of(const Motion& motion, std::uint64_t seed) {
  std::vector<Observation> result;
  Rng rng(seed);
  for (int placement = 0; placement < 12; ++placement) {
    std::vector<DeskBands> bands;
    std::vector<std::vector<NamedValue>> frames;
    for (int trial = 0; trial < 5; ++trial) {
      const auto frame = estimate_frame(desk_frame(motion, rng), kRig, {});
      bands.push_back(frame->desk_bands);
      frames.push_back(named_values(*frame));
    }
    const auto add = [&](std::string_view observable, std::string_view region, double value, double sd) {
      Observation o{
          .observable = std::string(observable), .factors = {}, .value = value, .repeat_sd = sd, .repeats = 5};
      o.factors.placement = placement;
      o.factors.region = region;
      result.push_back(std::move(o));
    };
    for (std::size_t k = 0; k < frames[0].size(); ++k) {
      std::vector<double> values;
      for (const auto& frame : frames) values.push_back(frame[k].value);
      add(frames[0][k].observable, frames[0][k].region, values[0], deviation(values));
    }
    for (const NamedValue& scatter : scatter_values(bands, kRig))
      add(scatter.observable, scatter.region, scatter.value, 0.0);
  }
  return result;
}

/// Of the three parts of the session their mean, in its own standard errors.
struct Found {
  double value = 0.0, z = 0.0;
};
Found found(const char* observable, const Motion& motion) {
  Found mean;
  for (const Observation& o : desk_motion(observations_of(motion, 7), kRig))
    if (o.observable == observable) {
      mean.value += o.value / 3.0;
      mean.z += o.value / (o.repeat_sd / std::sqrt(o.repeats)) / std::sqrt(3.0);
    }
  return mean;
}

/// Of seven placements there are no three parts with four in each.
TEST(DeskMotion, AShortSessionIsOfOnePart) {
  std::vector<Observation> observations = observations_of({.noise = 0.1, .along_rows = 0.1}, 7);
  std::erase_if(observations, [](const Observation& o) { return o.factors.placement >= 7; });
  const std::vector<Observation> motion = desk_motion(observations, kRig);
  ASSERT_EQ(motion.size(), 4U);
  EXPECT_EQ(motion[1].observable, "desk_waves_px");
  EXPECT_GT(motion[1].value / (motion[1].repeat_sd / std::sqrt(motion[1].repeats)), 3.0);
  std::erase_if(observations, [](const Observation& o) { return o.factors.placement >= 3; });
  EXPECT_TRUE(desk_motion(observations, kRig).empty());
}

constexpr double kSure = 5.0, kChance = 3.0;  // σ

TEST(DeskMotion, NoiseAloneIsNone) {
  EXPECT_LT(std::abs(found("desk_wander_mm", {.noise = 0.1}).z), kChance);
  EXPECT_LT(std::abs(found("desk_waves_px", {.noise = 0.1}).z), kChance);
}

TEST(DeskMotion, DeskThatMovesAsAWholeWandersAndMakesNoWaves) {
  const Motion motion{.noise = 0.1, .all = 0.1};
  const Found wander = found("desk_wander_mm", motion);
  const Plane desk = plane_from(DeskPrior{kRig.height_m, kRig.pitch_rad, kRig.roll_rad});
  const double expected =
      mm_from_metres(desk.offset * desk.offset * std::abs(desk.normal.z()) * 0.1 / (kRig.focal_px * kRig.baseline_m));
  EXPECT_GT(wander.z, kSure);
  EXPECT_NEAR(wander.value, expected, 0.35 * expected);  // 48 degrees of freedom: 3 σ and a little
  EXPECT_LT(std::abs(found("desk_waves_px", motion).z), kChance);
  EXPECT_LT(std::abs(found("desk_pitch_motion_deg", motion).z), kChance);
}

/// A wander of depth would lift the desk without changing the slope of its disparities.
TEST(DeskMotion, RowsThatAreShearedTurnTheDeskAndMakeNoCertainWander) {
  const Motion motion{.noise = 0.1, .shear = 0.1};
  EXPECT_GT(found("desk_pitch_motion_deg", motion).z, kSure);
  EXPECT_LT(std::abs(found("desk_wander_mm", motion).z), kChance);
}

TEST(DeskMotion, RowsThatShakeMakeWavesAndNoCertainMotionOfThePlane) {
  const Motion motion{.noise = 0.1, .along_rows = 0.1};
  const Found waves = found("desk_waves_px", motion);
  EXPECT_GT(waves.z, kSure);
  EXPECT_GT(waves.value, 0.05);  // 0.07 px are a sine's root mean square, of which bands and the plane take some
  EXPECT_LT(waves.value, 0.08);
  EXPECT_LT(std::abs(found("desk_wander_mm", motion).z), kChance);
  EXPECT_LT(std::abs(found("desk_pitch_motion_deg", motion).z), kChance);
}

TEST(DeskMotion, ASensorThatTremblesMovesItsPitchAlone) {
  const Motion motion{.noise = 0.1, .pitch_deg = 0.05};
  const Found pitch = found("desk_pitch_motion_deg", motion);
  EXPECT_GT(pitch.z, kSure);
  EXPECT_NEAR(pitch.value, 0.05, 0.35 * 0.05);  // 48 degrees of freedom: 3 σ and a little
  EXPECT_LT(std::abs(found("desk_roll_motion_deg", motion).z), kChance);
  EXPECT_LT(std::abs(found("desk_pitch_motion_deg", {.noise = 0.1}).z), kChance);
}

/// Chance makes a variance, so the root of one is as significant as it. What other trials would have shown is a share
/// of the root, half as large as of the variance.
TEST(DeskMotion, ARootIsUncertainByChanceAndByHalfItsSampling) {
  const auto error = [](VarianceExcess excess) {
    const Observation root = root_of(excess, "desk_wander_mm", {}, 4);
    return root.repeat_sd / std::sqrt(root.repeats);
  };
  EXPECT_NEAR(error({.value = 4.0, .error = 1.0}), 0.5, 1e-12);
  EXPECT_NEAR(error({.value = 4.0, .error = 0.0, .sampling = 1.0}), 0.25, 1e-12);
  EXPECT_NEAR(error({.value = 0.0, .error = 4.0}), 2.0, 1e-12);
}

TEST(DeskMotion, ColumnsThatShakeAreToldFromRows) {
  EXPECT_LT(found("desk_waves_px", {.noise = 0.1, .along_columns = 0.1}).z, -kSure + 2.0);
}

TEST(DeskBands, OneFrameTellsNothing) {
  Rng rng(1);
  const auto frame = estimate_frame(desk_frame({.noise = 0.1}, rng), kRig, {});
  const std::vector<DeskBands> one{frame->desk_bands};
  EXPECT_TRUE(scatter_values(one, kRig).empty());
}

}  // namespace desk_motion_test
}  // namespace fathom
