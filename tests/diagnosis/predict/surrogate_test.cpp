// The few rays of the surrogate against whole geometric frames, under the same estimators.
#include "diagnosis/predict/surrogate.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/estimate.h"
#include "diagnosis/measurement/named_values.h"
#include "diagnosis/predict/predictor.h"
#include "sim/sensor/capture.h"
#include "tests/diagnosis/predict/paper_laboratory.h"

namespace fathom {
namespace {

struct Case {
  const char* liquid;
  double fill_mm, distance_mm, lateral_mm;
  Json effects;
};

std::vector<SensedPoint> points_of(const Image<CloudPoint>& cloud) {
  std::vector<SensedPoint> points;
  for (const CloudPoint& p : cloud.pixels())
    if (p.z == p.z) points.push_back({{p.x, p.y, p.z}, p.intensity});
  return points;
}

class SurrogateAgainstFrames : public testing::TestWithParam<Case> {};

TEST_P(SurrogateAgainstFrames, SaysWhatTheFrameSays) {
  const Case& c = GetParam();
  const LaboratoryRig rig = paper_laboratory();
  const Factors factors = paper_shot(c.liquid, c.fill_mm, c.distance_mm, c.lateral_mm);
  const fathom::Setup setup = paper_setup(factors, c.effects);
  const FrameView view = view_of(factors);
  Camera camera(setup, CaptureMode::geometric, 1, 1);
  const auto frame = estimate_frame(points_of(camera.shoot(0).cloud), rig, view);
  const auto few = surrogate_frame(setup, rig, sample_pixels(rig, view)).estimates;
  ASSERT_TRUE(frame && few);
  // Heights: the task of the surrogate. A region's border cuts pixels of 1.3 mm, and a wall's shadow as well.
  constexpr double kHeightMm = 0.05;
  // The plane: a frame has the desk's finite size and the cup's shadow, which matter where distortion bends it.
  constexpr double kDeskMm = 0.03;
  for (std::size_t i = 0; i < frame->height.size(); ++i) {
    if (frame->height[i].weight < 60.0) continue;  // a sliver at the wall's shadow: few rays, and half of them grazing
    EXPECT_NEAR(mm_from_metres(few->height[i].mean), mm_from_metres(frame->height[i].mean), kHeightMm)
        << kCupRegionNames[i] << " of " << frame->height[i].weight << " pixels";
    EXPECT_NEAR(few->height[i].weight / frame->height[i].weight, 1.0, 0.15) << kCupRegionNames[i];
  }
  // The walls: rays stand 3 pixels apart, so that a step of 5 mm on a wall more or less counts as one of its ends.
  constexpr double kWallMm = 0.1;
  ASSERT_TRUE(frame->outline && few->outline);
  EXPECT_NEAR(mm_from_metres(few->outline->off.x()), mm_from_metres(frame->outline->off.x()), kWallMm);
  EXPECT_NEAR(mm_from_metres(few->outline->off.y()), mm_from_metres(frame->outline->off.y()), kWallMm);
  EXPECT_NEAR(mm_from_metres(few->outline->wider), mm_from_metres(frame->outline->wider), kWallMm);
  EXPECT_NEAR(mm_from_metres(few->desk.offset), mm_from_metres(frame->desk.offset), kDeskMm);
  EXPECT_NEAR(pitch_above(few->desk), pitch_above(frame->desk), radians_from_deg(0.003));
}

INSTANTIATE_TEST_SUITE_P(
    Frames, SurrogateAgainstFrames,
    testing::Values(Case{"empty", 0, 200, 0, {}}, Case{"empty", 0, 400, 0, {}}, Case{"water", 10, 300, 0, {}},
                    Case{"water", 30, 200, 0, {}}, Case{"water", 30, 400, 0, {}}, Case{"water", 30, 500, 0, {}},
                    Case{"water", 20, 400, 150, {}}, Case{"milk", 20, 300, 0, {}}, Case{"milk", 30, 500, -100, {}},
                    Case{"milk", 50, 300, 0, {}}, Case{"milk", 50, 450, 100, {}},
                    Case{"water", 30, 300, 0, Json::parse(R"([{"name": "sensor_pitch", "pitch_deg": 0.5}])")},
                    Case{"water", 30, 300, 0, Json::parse(R"([{"name": "baseline", "baseline_mm": 0.5}])")},
                    Case{"water", 30, 300, 0, Json::parse(R"([{"name": "focal_length", "focal_px": 3}])")},
                    Case{"water", 30, 300, 120, Json::parse(R"([{"name": "principal_point", "x_px": 3}])")},
                    Case{"milk", 30, 300, -120, Json::parse(R"([{"name": "cup_placement", "x_mm": 3, "y_mm": -4}])")},
                    Case{"milk", 30, 200, 0, Json::parse(R"([{"name": "cup_placement", "y_mm": -8}])")},
                    Case{"water", 30, 300, 0, Json::parse(R"([{"name": "cup_placement", "x_mm": 20, "y_mm": 15}])")},
                    Case{"milk", 20, 400, 0, Json::parse(R"([{"name": "cup_placement", "x_mm": -25}])")},
                    Case{"water", 30, 300, 0, Json::parse(R"([{"name": "radial_distortion", "k1": 0.01}])")},
                    Case{"water", 30, 300, 0, Json::parse(R"([{"name": "surface_tilt", "slope_x_deg": 1}])")},
                    Case{"water", 30, 300, 0, Json::parse(R"([{"name": "meniscus", "contact_angle_deg": 30}])")},
                    Case{"milk", 30, 300, 0, Json::parse(R"([{"name": "meniscus", "contact_angle_deg": 30}])")},
                    Case{"water", 30, 300, 0, Json::parse(R"([{"name": "stratification", "index_step": 0.05}])")},
                    Case{"empty", 0, 300, 0, Json::parse(R"([{"name": "concave_bottom", "depth_mm": 2}])")},
                    Case{"water", 30, 300, 0, Json::parse(R"([{"name": "concave_bottom", "depth_mm": 1}])")},
                    Case{"water", 30, 300, 0, Json::parse(R"([{"name": "window_averaging", "window_px": 9}])")}));

// Waves of 0.2 mm, by moments that the surrogate does not use, with a device's windows, which hold most of a wave:
// points of single rays would lie 0.05 mm higher. Each shot is off by some tenths of a millimetre.
TEST(Surrogate, SaysOfWavesWhatFramesSayInTheMean) {
  const LaboratoryRig rig = paper_laboratory();
  const Factors factors = paper_shot("water", 20.0, 300.0);
  const SampledPixels pixels = sample_pixels(rig, view_of(factors));
  const fathom::Setup still = paper_setup(factors, Json::parse(R"([{"name": "window_averaging", "window_px": 9}])"));
  const auto shot_mm = [&](const fathom::Setup& setup) {
    const Image<CloudPoint> cloud = Camera(setup, CaptureMode::geometric, 1, 1).shoot(0).cloud;
    return mm_from_metres(estimate_frame(points_of(cloud), rig, view_of(factors)).value().height[0].mean);
  };
  const auto few_mm = [&](const fathom::Setup& setup) {
    return mm_from_metres(surrogate_frame(setup, rig, pixels).estimates.value().height[0].mean);
  };
  const double level = shot_mm(still);
  double few = 0.0;
  Mean changes;
  fathom::Setup moved = still;
  for (int direction = 0; direction < 4; ++direction)
    for (int third = 0; third < 3; ++third) {
      const double azimuth = 0.3 + 0.25 * std::numbers::pi * direction,
                   phase = 0.4 + 2.0 / 3.0 * std::numbers::pi * third;
      moved.scene.cups[0].filling->form.ripples = {{0.015, 0.0002, azimuth, phase}};
      changes.add(shot_mm(moved) - level);
      few = few_mm(moved) - few_mm(still);
    }
  const auto [mean, error] = changes.estimate();
  const double scatter = error * std::sqrt(static_cast<double>(changes.count() - 1));
  EXPECT_LT(few, -0.05);         // waves deepen what they show
  EXPECT_NEAR(few, mean, 0.02);  // pixels at a region's border come and go
  EXPECT_GT(scatter, 0.05);
  EXPECT_NEAR(under_waves(moved, rig, pixels).value().scatter_mm / scatter, 1.0, 0.5);
  EXPECT_FALSE(under_waves(still, rig, pixels));
}

// Of their slope's second order, whatever its size: rays that steep waves throw aside neither stick nor turn the sign.
TEST(Surrogate, DeepensWhatWavesShowByTheirMeanSquareSlope) {
  const LaboratoryRig rig = paper_laboratory();
  const Factors factors = paper_shot("water", 30.0, 200.0);
  const SampledPixels pixels = sample_pixels(rig, view_of(factors));
  const auto height_mm = [&](double mean_square_slope) {
    const Json waves = {{{"name", "ripples"}, {"mean_square_slope", mean_square_slope}}};
    return mm_from_metres(surrogate_frame(paper_setup(factors, waves), rig, pixels).estimates.value().height[0].mean);
  };
  const double still = height_mm(0.0), per_slope = (height_mm(0.0025) - still) / 0.0025;
  EXPECT_LT(per_slope, -50.0);
  constexpr double kFourthOrder = 0.15;  // share: slopes of a third refract by a tenth more than their sine
  for (const double slope : {0.005, 0.01, 0.02, 0.03})
    EXPECT_NEAR((height_mm(slope) - still) / (per_slope * slope), 1.0, kFourthOrder) << slope;
}

TEST(Surrogate, KnowsOnWhichCodesDepthsStand) {
  const LaboratoryRig rig = paper_laboratory();
  const Factors factors = paper_shot("water", 20.0, 300.0);
  const SampledPixels pixels = sample_pixels(rig, view_of(factors));
  const auto quantized = [&](const Json& effects) {
    fathom::Setup setup = paper_setup(factors, effects);
    setup.rig.sensor.law.quantized = true;
    return setup;
  };
  const SurrogateFrame nominal = surrogate_frame(quantized(Json::array()), rig, pixels);
  const double strength = nominal.estimates.value().step_comb;
  ASSERT_GT(strength, 0.4);
  for (const double phase : {0.25, 0.5}) {
    const Json moved = {{{"name", "depth_step_phase"}, {"phase_steps", phase}}};
    const FrameEstimates seen = surrogate_frame(quantized(moved), rig, pixels, &nominal).estimates.value();
    EXPECT_NEAR(seen.step_comb, strength * std::cos(2.0 * std::numbers::pi * phase), 1e-12);
    EXPECT_EQ(seen.height[0].mean, nominal.estimates->height[0].mean);
  }
}

/// What the walls say of a cup with an effect, less what they say without one [mm].
Eigen::Vector3d moved_by(const Json& effects, double distance_mm, double lateral_mm) {
  const LaboratoryRig rig = paper_laboratory();
  const Factors factors = paper_shot("empty", 0.0, distance_mm, lateral_mm);
  const auto seen = [&](const Json& those) -> Eigen::Vector3d {
    const FrameEstimates frame =
        surrogate_frame(paper_setup(factors, those), rig, sample_pixels(rig, view_of(factors))).estimates.value();
    const CupOutline& outline = frame.outline.value();
    return 1e3 * Eigen::Vector3d(outline.off.x(), outline.off.y(), outline.wider);
  };
  return seen(effects) - seen(Json::array());
}

TEST(CupsOutline, GoesWithTheCup) {
  for (const double mm : {2.0, 8.0, 14.0, 20.0}) {
    const Json beside = {{{"name", "cup_placement"}, {"x_mm", mm}, {"y_mm", -mm}}};
    const Eigen::Vector3d moved = moved_by(beside, 300, 0);
    constexpr double kWalls = 0.1;  // mm: as against whole frames
    EXPECT_NEAR(moved.x(), mm, kWalls);
    EXPECT_NEAR(moved.y(), -mm, kWalls);
    EXPECT_NEAR(moved.z(), 0.0, kWalls);
  }
}

/// The same frame, of whose walls every third point has fallen out.
std::vector<SensedPoint> with_gaps_in_walls(std::vector<SensedPoint> points, const LaboratoryRig& rig,
                                            const Eigen::Vector2d& place) {
  const Eigen::Isometry3d to_desk = desk_from_camera(plane_from({rig.height_m, rig.pitch_rad, rig.roll_rad}));
  int walls = 0;
  std::erase_if(points, [&](const SensedPoint& sensed) {
    const Eigen::Vector3d point = to_desk * sensed.point.cast<double>();
    const double radius = (point.head<2>() - axis_from_camera(rig, place)).norm();
    const bool is_wall = radius > rig.cup.narrowest() - 0.0005 && radius < rig.cup.widest() + 0.0005;
    return is_wall && ++walls % 3 == 0;
  });
  return points;
}

// An opaque surface that stands near the rim has an edge that is no wall, however few of the wall's own points remain.
TEST(CupsOutline, IsTheRigsAboveAnyFillOfALiquid) {
  const LaboratoryRig rig = paper_laboratory();
  for (const double fill_mm : {30.0, 40.0, 50.0, 60.0})
    for (const double distance_mm : {300.0, 450.0}) {
      const Factors factors = paper_shot("milk", fill_mm, distance_mm);
      const FrameView view = view_of(factors);
      Camera camera(paper_setup(factors, Json::array()), CaptureMode::geometric, 1, 1);
      const auto points = with_gaps_in_walls(points_of(camera.shoot(0).cloud), rig, *view.cup);
      const FrameEstimates frame = estimate_frame(points, rig, view).value();
      ASSERT_TRUE(frame.outline) << fill_mm << " mm, seen from " << distance_mm;
      EXPECT_NEAR(mm_from_metres(frame.outline->wider), 0.0, 0.1) << fill_mm << " mm, seen from " << distance_mm;
    }
}

TEST(CupsOutline, WidensWithTheCup) {
  const Eigen::Vector3d moved = moved_by(Json::parse(R"([{"name": "wrong_cup", "scale": 0.05}])"), 300, 0);
  EXPECT_NEAR(moved.z(), 0.05 * 41.5, 0.15);  // radii of 40 and 43 mm; a taller cup shows other heights of its walls
  EXPECT_NEAR(moved.head<2>().norm(), 0.0, 0.1);
}

// A longer baseline than believed makes all depths shorter in proportion, but for those on the reference plane, 1.2 m
// away: depths z become z / (1 + s (1 − z / 1.2 m)). A height of the sensor changes no place on the desk.
TEST(CupsOutline, TellsTheDesksScaleFromTheSensorsHeight) {
  const Json longer = Json::parse(R"([{"name": "baseline", "baseline_mm": 0.75}])");
  const double farther = moved_by(longer, 400, 0).y() - moved_by(longer, 200, 0).y();
  EXPECT_LT(farther, -0.5);  // of 200 mm, 1 % less two thirds of it …
  EXPECT_GT(farther, -2.0);  // … and no more than 1 %
  const Json higher = Json::parse(R"([{"name": "sensor_height", "height_mm": 3}])");
  EXPECT_NEAR(moved_by(higher, 400, 0).y(), moved_by(higher, 200, 0).y(), 0.1);
}

/// A shot of the bare desk, and what the surrogate makes of it.
std::pair<FrameEstimates, FrameEstimates> desk_with(const Json& effects, const FrameView& view = {}) {
  const LaboratoryRig rig = paper_laboratory();
  Factors factors;
  factors.liquid = "none";
  const fathom::Setup setup = paper_setup(factors, effects);
  Camera camera(setup, CaptureMode::geometric, 1, 1);
  const auto frame = estimate_frame(points_of(camera.shoot(0).cloud), rig, view);
  const auto few = surrogate_frame(setup, rig, sample_pixels(rig, view)).estimates;
  return {frame.value(), few.value()};
}

TEST(Combs, TellHowCoarseTheStepsAre) {
  for (const double step_px : {0.125, 0.25, 0.5}) {
    const auto [frame, few] = desk_with({{{"name", "depth_quantization"}, {"law", 1}, {"step_px", step_px}}});
    // Depths are no even mixture of steps, as the model's error of combs has it.
    constexpr double kComb = 0.1;
    for (std::size_t i = 0; i < kCoarseCombs.size(); ++i) {
      EXPECT_NEAR(few.coarse_combs[i], frame.coarse_combs[i], kComb) << step_px;
      EXPECT_EQ(few.coarse_combs[i] > 0.5, step_px >= 0.125 * kCoarseCombs[i]);
    }
    EXPECT_NEAR(few.step_comb, frame.step_comb, kComb);
    // Half a step has no code of its own: the device takes the farther one, half of 1/8 px or 0.7 mm behind.
    EXPECT_NEAR(mm_from_metres(few.desk.offset), mm_from_metres(frame.desk.offset), 0.1);
  }
}

/// Codes are wider far away, so that a comb is that of the part of the desk that clouds show.
TEST(Combs, AreThoseOfTheDeskThatIsSeen) {
  const Json law{{{"name", "depth_quantization"}, {"law", 1}}};
  FrameView near;
  near.desk_px = Eigen::AlignedBox2d(Eigen::Vector2d(0.0, 280.0), Eigen::Vector2d(640.0, 480.0));
  const auto [frame, few] = desk_with(law, near);
  EXPECT_NEAR(few.step_comb, frame.step_comb, 0.1);
  EXPECT_LT(few.step_comb, desk_with(law).second.step_comb - 0.1);
}

TEST(Combs, OfADeskInFewCodesAreNotLookedAt) {
  LaboratoryRig rig = paper_laboratory();
  rig.pitch_rad = radians_from_deg(90.0);
  std::vector<SensedPoint> points;
  for (int row = 0; row < 480; row += 8)
    for (int column = 0; column < 640; column += 8)
      points.push_back({{0.65f * (static_cast<float>(column) - 320.0f) / 570.0f,
                         0.65f * (static_cast<float>(row) - 240.0f) / 570.0f, 0.65f},
                        0.0f});
  const auto frame = estimate_frame(points, rig, {});
  ASSERT_TRUE(frame);
  for (const NamedValue& value : named_values(*frame)) EXPECT_NE(value.observable, "comb_half");
}

}  // namespace
}  // namespace fathom
