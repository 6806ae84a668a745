// What every effect of the registry moves, which way and how far, by a figure that does not come from it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "core/error.h"
#include "diagnosis/measurement/named_values.h"
#include "diagnosis/predict/predictor.h"
#include "sim/effects/effects_json.h"
#include "sim/effects/registry.h"
#include "tests/core/expect_error.h"
#include "tests/diagnosis/predict/paper_laboratory.h"

namespace fathom {
namespace {

struct Scenery {
  const char* liquid;
  double fill_mm, distance_mm;
  double time_s = 0.0, stood_s = 0.0;
  const char* effects = "[]";  ///< that are there before
};

/// The value of one observable; nothing when the surrogate has none.
std::optional<double> value_of(const Scenery& scenery, const Json& effect, std::string_view observable,
                               std::string_view region) {
  const LaboratoryRig rig = paper_laboratory();
  Factors factors = paper_shot(scenery.liquid, scenery.fill_mm, scenery.distance_mm);
  factors.time_s = scenery.time_s;
  factors.stood_s = scenery.stood_s;
  Json effects = Json::parse(scenery.effects);
  if (!effect.is_null()) effects.push_back(effect);
  const fathom::Setup setup = paper_setup(factors, std::move(effects));
  const auto estimates = surrogate_frame(setup, rig, sample_pixels(rig, view_of(factors))).estimates;
  if (!estimates) return std::nullopt;
  for (const NamedValue& value : named_values(*estimates))
    if (value.observable == observable && value.region == region) return value.value;
  return std::nullopt;
}

constexpr Scenery kEmpty{"empty", 0, 300}, kWater{"water", 30, 300}, kMilk{"milk", 20, 300};

struct Row {
  const char* effect;  ///< as in a scene
  Scenery scenery;
  const char *observable, *region;
  double low, high;  ///< of the change; of the ratio where it is a brightness
  const char* why;
};

// The desk is the plane 1/z = q · (x/z, y/z, 1) with q = (0, cos p, sin p) / h, p 58.4° and h 650 mm; a device that
// errs changes q, and the height it finds is 1/|q|.
const Row kRows[] = {
    {R"({"name": "sensor_height", "height_mm": 1})", kEmpty, "desk_height_mm", "desk", 0.999, 1.001, "by definition"},
    {R"({"name": "sensor_pitch", "pitch_deg": 0.5})", kEmpty, "desk_pitch_deg", "desk", 0.4999, 0.5001, "the same"},
    {R"({"name": "sensor_roll", "roll_deg": 0.5})", kEmpty, "desk_roll_deg", "desk", 0.4999, 0.5001, "the same"},
    {R"({"name": "baseline", "baseline_mm": 0.5})", kEmpty, "desk_height_mm", "desk", -2.34, -2.31,
     "q · 75.5/75 − (0, 0, 0.5/75/1.2 m): 647.67 mm"},
    {R"({"name": "focal_length", "focal_px": 3})", kEmpty, "desk_height_mm", "desk", -0.92, -0.89,
     "only the third of q, as above, because directions scale as well: 649.10 mm"},
    {R"({"name": "principal_point", "y_px": 2})", kEmpty, "desk_height_mm", "desk", 1.0, 1.03,
     "third of q less the second times 2/570: 651.02 mm"},
    {R"({"name": "disparity_offset", "offset_px": 0.1})", kEmpty, "desk_height_mm", "desk", -0.86, -0.83,
     "third of q more by 0.1 / (f b): 649.16 mm"},
    {R"({"name": "radial_distortion", "k1": 0.03})", kEmpty, "desk_residual_mm", "middle", -3.0, -1.5,
     "20 px from the reference grow by k1 (3 x² + y²), of which the fit takes the mean: 0.37 · k1 less 0.04 · k1, 12 "
     "mm a px"},
    {R"({"name": "depth_quantization", "law": 1})", kEmpty, "desk_height_mm", "desk", -0.6, -0.3,
     "0.5 mm along lines of sight, of which 0.65 / 0.75 is height"},
    {R"({"name": "thermal_drift", "start_px": 0.1})", kEmpty, "desk_height_mm", "desk", -0.86, -0.83,
     "as disparity_offset, when the session begins"},
    {R"({"name": "thermal_drift", "start_px": 0.1})",
     {"empty", 0, 300, 9400.0},
     "desk_height_mm",
     "desk",
     -1e-4,
     0.0,
     "gone after ten time constants"},
    {R"({"name": "thermal_drift", "start_px": 0.1, "settling_s": 600})",
     {"empty", 0, 300, 600.0},
     "desk_height_mm",
     "desk",
     -0.316,
     -0.305,
     "1/e of that above"},
    {R"({"name": "depth_wander", "sd_px": 0.1})", kEmpty, "desk_height_mm", "desk", 0.0, 0.0, "its mean is 0"},
    {R"({"name": "refractive_index", "index_change": 0.01})", kWater, "height_mm", "centre", 0.17, 0.20,
     "w n cos A / (n² − sin² A)^1.5 with A 26°: 0.18 mm"},
    {R"({"name": "absorption", "absorption_per_mm": 0.005})", kWater, "log_brightness", "interior", 0.715, 0.74,
     "exp(−0.005 · 2 · 30 / 0.945)"},
    {R"({"name": "subsurface_scattering", "transport_length_mm": 1})", kMilk, "height_mm", "centre", -0.40, -0.37,
     "from either side 0.57 of a path aside, along the baseline: 2 · 0.57 (37.5 mm / 692 mm) 623 mm / (75 mm n) = "
     "0.38"},
    {R"({"name": "subsurface_scattering", "transport_length_mm": 1})", kWater, "height_mm", "centre", 0.0, 0.0,
     "water does not scatter"},
    {R"({"name": "stratification", "index_step": 0.05})", kWater, "height_mm", "centre", 0.40, 0.50,
     "as refractive_index, over 15 mm"},
    {R"({"name": "meniscus", "contact_angle_deg": 30})", kMilk, "height_mm", "far", 0.005, 0.08,
     "2.73 mm at the wall, a 40th of it 10 mm away"},
    {R"({"name": "surface_tilt", "slope_y_deg": 1})", kMilk, "height_mm", "far", 0.33, 0.40,
     "tan 1° at the far sector's centroid, 21 mm from the axis"},
    {R"({"name": "foam", "thickness_mm": 2})", kMilk, "height_mm", "centre", 1.99, 2.01, "by definition"},
    {R"({"name": "ripples", "mean_square_slope": 0.0877})", kMilk, "height_sd_mm", "interior", 0.6, 0.78,
     "1/√2 of a sine of 1 mm: (2π 1 mm / 15 mm)² / 2 = 0.0877"},
    {R"({"name": "cup_bottom_height", "height_mm": 1})", kEmpty, "height_mm", "centre", 0.99, 1.01, "by definition"},
    {R"({"name": "concave_bottom", "depth_mm": 2})", kEmpty, "height_mm", "far", -1.34, -1.25,
     "2 mm times the ring's mean of (r/40 mm)², less 2 mm: -1.30 mm"},
    {R"({"name": "concave_bottom", "depth_mm": 2})", kMilk, "height_mm", "centre", -0.01, 0.01,
     "a ruler stands at the wall"},
    {R"({"name": "concave_bottom", "depth_mm": -2})", kMilk, "height_mm", "centre", -0.01, 0.01, "and so on a dome"},
    {R"({"name": "wall_albedo", "albedo": 0.1})", kEmpty, "log_brightness", "interior", 1.1427, 1.1430, "0.8 / 0.7"},
    {R"({"name": "cup_placement", "y_mm": 10})", kWater, "height_mm", "centre", 0.03, 0.12,
     "Eq. 7 at 310 mm less at 300 mm: 0.065 mm"},
    {R"({"name": "cup_placement", "y_mm": 2})", kWater, "cup_y_mm", "walls", 1.9, 2.1, "by definition"},
    {R"({"name": "wall_multipath", "share": 1})", kWater, "height_mm", "centre", 0.0, 0.0, "no direct light"},
    {R"({"name": "specular_ghost", "share": 1})", kWater, "height_mm", "centre", 0.0, 0.0, "no direct light"},
    {R"({"name": "fill_offset", "fill_mm": 1})", kMilk, "height_mm", "centre", 0.99, 1.01, "by definition"},
    {R"({"name": "fill_offset", "fill_mm": 1})", kEmpty, "height_mm", "centre", 0.0, 0.0, "nothing was poured"},
    {R"({"name": "fill_scale", "scale": 0.1})", kMilk, "height_mm", "centre", 1.99, 2.01, "a tenth of 20 mm"},
    {R"({"name": "evaporation", "rate_mm_per_h": 2})",
     {"milk", 20, 300, 3600.0, 1800.0},
     "height_mm",
     "centre",
     -1.01,
     -0.99,
     "half an hour of 2 mm an hour"},
    {R"({"name": "evaporation", "rate_mm_per_h": 50})",
     {"milk", 20, 300, 3600.0},
     "height_mm",
     "centre",
     0.0,
     0.0,
     "just poured, however long the session has lasted"},
    {R"({"name": "evaporation", "rate_mm_per_h": 50})",
     {"milk", 1, 300, 3600.0, 3600.0},
     "height_mm",
     "centre",
     -1.01,
     -0.99,
     "no more can go than was there"},
    {R"({"name": "label_swap", "swapped": 1})", kMilk, "height_mm", "centre", -15.5, -14.0,
     "water of 20 mm raises its bottom by 28 %: 20 · (1 − 0.28) lower than its surface"},
    {R"({"name": "unit_error", "factor": 1.5})", kMilk, "height_mm", "centre", 9.95, 10.05, "half of 20 mm more"},
    {R"({"name": "wrong_cup", "scale": 0.1})", kEmpty, "height_mm", "centre", 0.69, 0.71, "a tenth of 7 mm"},
    {R"({"name": "window_averaging", "window_px": 9})",
     {"milk", 60, 200, 0.0, 0.0, R"([{"name": "ripples", "mean_square_slope": 0.0877}])"},
     "height_sd_mm",
     "interior",
     -0.43,
     -0.34,
     "1/√2 mm, of which a window of 9.8 mm leaves sinc(9.8/15) = 0.43 of waves of 15 mm, nine places of it 0.47"},
    {R"({"name": "window_averaging", "window_px": 9})",
     {"milk", 60, 200},
     "height_mm",
     "centre",
     -0.005,
     0.005,
     "a plane's disparity is linear in the pixel, its height nearly so"},
    {R"({"name": "skew_approximation", "share": 1})",
     {"water", 30, 400},
     "height_mm",
     "centre",
     -0.08,
     -0.02,
     "Eq. 7 gives 9.167 mm where the exact triangulation has 9.210 mm"},
    {R"({"name": "colour_registration", "registered": 1})", kEmpty, "cup_x_mm", "walls", -25.01, -24.99,
     "the colour camera stands 25 mm to the right"},
    // What a picture's noise and its steps say is not among what some hundred rays predict: bench/real_desks.
    {R"({"name": "depth_step_phase", "phase_steps": 0.5})", kEmpty, "desk_height_mm", "desk", 0.0, 0.0,
     "the same mean"},
    {R"({"name": "depth_truncation", "cut": 1})", kEmpty, "desk_height_mm", "desk", 0.0, 0.0, "not on the law"},
    {R"({"name": "noise_correlation", "wider_px": 8})", kEmpty, "desk_height_mm", "desk", 0.0, 0.0, "noise"},
    {R"({"name": "reference_residue", "sd_px": 0.1})", kEmpty, "desk_height_mm", "desk", 0.0, 0.0, "its mean is 0"},
};

TEST(Effects, MoveWhatTheySayByWhatTheyShould) {
  for (const Row& row : kRows) {
    const auto before = value_of(row.scenery, nullptr, row.observable, row.region);
    const auto after = value_of(row.scenery, Json::parse(row.effect), row.observable, row.region);
    ASSERT_TRUE(before && after) << row.effect;
    const bool brightness = std::string_view(row.observable) == "log_brightness";
    const double change = brightness ? std::exp(*after - *before) : *after - *before;
    EXPECT_TRUE(change >= row.low && change <= row.high)
        << row.effect << ' ' << row.observable << ' ' << row.region << ": " << change << ", " << row.why;
  }
}

/// A row that an effect which does nothing would fail.
TEST(Effects, EachHasARowThatItMoves) {
  // These show in pictures and in how they scatter, which tests/effects looks at.
  std::set<std::string> tested{"depth_wander",     "wall_multipath",    "specular_ghost",   "depth_step_phase",
                               "depth_truncation", "noise_correlation", "reference_residue"};
  for (const Row& row : kRows) {
    const double unmoved = std::string_view(row.observable) == "log_brightness" ? 1.0 : 0.0;
    if (unmoved < row.low || unmoved > row.high) tested.insert(Json::parse(row.effect)["name"]);
  }
  for (const std::string& id : effect_ids()) EXPECT_TRUE(tested.count(id)) << id;
}

TEST(Effects, AtTheirNominalValuesChangeNothing) {
  for (const Scenery& scenery : {kEmpty, kWater, kMilk})
    for (const std::string& id : effect_ids())
      for (const char* region : {"centre", "far", "left"})
        EXPECT_EQ(value_of(scenery, {{"name", id}}, "height_mm", region),
                  value_of(scenery, nullptr, "height_mm", region))
            << id;
}

TEST(Effects, FadeAsTheirParametersDo) {
  const std::set<std::string> on_or_off{"depth_quantization", "label_swap", "foam"};
  for (const Effect& effect : effect_registry()) {
    if (on_or_off.count(std::string(effect.id))) continue;
    for (const EffectParameter& p : effect.parameters) {
      const auto change = [&](double share) {
        const Json switched = {{"name", effect.id}, {p.name, p.nominal + share * p.scale}};
        return *value_of(kWater, switched, "height_mm", "far") - *value_of(kWater, nullptr, "height_mm", "far");
      };
      // Pixels at a shadow's edge come and go one by one, each worth a 300th of some tenths of a millimetre.
      constexpr double kOnePixel = 0.003;
      EXPECT_LE(std::abs(change(1.0 / 64)), std::abs(change(1.0)) / 16 + kOnePixel) << effect.id << ' ' << p.name;
    }
  }
}

TEST(Effects, WanderHasItsDeviationAndAFrameItsOwn) {
  UnitModel unit;
  unit.wander_px = 0.2;
  unit.on_for_s = 0.0;
  constexpr int kFrames = 4000;
  double squares = 0.0;
  for (int frame = 0; frame < kFrames; ++frame) squares += std::pow(unit_error(unit, frame).offset_px, 2);
  // A standard deviation of 4000 draws is good to 1.1 %; four of these.
  EXPECT_NEAR(std::sqrt(squares / kFrames), 0.2, 0.2 * 0.045);
  EXPECT_EQ(unit_error(unit, 7).offset_px, unit_error(unit, 7).offset_px);
}

TEST(Effects, RegistryIsTheListOfTheDiagnosis) {
  const std::set<std::string> expected{"sensor_height",
                                       "sensor_pitch",
                                       "sensor_roll",
                                       "baseline",
                                       "focal_length",
                                       "principal_point",
                                       "disparity_offset",
                                       "radial_distortion",
                                       "depth_quantization",
                                       "thermal_drift",
                                       "depth_wander",
                                       "depth_step_phase",
                                       "depth_truncation",
                                       "noise_correlation",
                                       "reference_residue",
                                       "refractive_index",
                                       "absorption",
                                       "subsurface_scattering",
                                       "stratification",
                                       "meniscus",
                                       "surface_tilt",
                                       "foam",
                                       "ripples",
                                       "cup_bottom_height",
                                       "concave_bottom",
                                       "wall_albedo",
                                       "cup_placement",
                                       "wall_multipath",
                                       "specular_ghost",
                                       "fill_offset",
                                       "fill_scale",
                                       "evaporation",
                                       "label_swap",
                                       "unit_error",
                                       "wrong_cup",
                                       "window_averaging",
                                       "skew_approximation",
                                       "colour_registration"};
  std::set<std::string> ids;
  for (const Effect& effect : effect_registry()) {
    EXPECT_TRUE(ids.insert(std::string(effect.id)).second) << effect.id << " twice";
    EXPECT_FALSE(effect.sentence.empty() || effect.citation.empty() || effect.discriminated_by.empty()) << effect.id;
    for (const std::string_view twin : effect.confounded) EXPECT_TRUE(find_effect(twin)) << effect.id << ": " << twin;
    for (const EffectParameter& p : effect.parameters)
      EXPECT_TRUE(p.lower <= p.nominal && p.nominal <= p.upper && p.scale > 0.0) << effect.id << ' ' << p.name;
  }
  EXPECT_EQ(ids, expected);
}

TEST(Effects, MistakesInAListNameTheirPlaceAndTheChoices) {
  const auto switched = [](const char* list) {
    fathom::Setup setup;
    setup.file = "scene.json";
    setup.effects = Json::parse(list);
    return [setup] { with_effects(setup); };
  };
  expect_error(switched(R"([{"name": "foma"}])"),
               {"scene.json: /effects/0/name: unknown effect 'foma', choose from sensor_height, "});
  expect_error(
      switched(R"([{"name": "foam"}, {"name": "foam", "thick_mm": 1}])"),
      {"scene.json: /effects/1/thick_mm: unknown parameter of foam 'thick_mm', choose from thickness_mm, liquid"});
  expect_error(switched(R"([{"name": "foam", "thickness_mm": -1}])"),
               {"scene.json: /effects/0/thickness_mm: must be a number from 0 to 20, got -1"});
}

TEST(Effects, AnIndexFallsToItsFloorAndIsNeverLiftedToIt) {
  const Effect* effect = find_effect("refractive_index");
  ASSERT_TRUE(effect);
  for (const auto& [n, change, changed] : {std::array{1.33, -0.01, 1.32}, {1.33, -0.1, 1.28}, {1.25, -0.01, 1.25}}) {
    fathom::Setup setup = paper_setup(paper_shot("water", 20.0, 300.0), Json::array());
    Medium& medium = setup.scene.cups[0].filling->medium;
    medium.index = ConstantIndex{n};
    const std::array values{change};
    effect->apply(setup, {values, ""});
    EXPECT_DOUBLE_EQ(medium.n(setup.rig.sensor.wavelength_nm), changed);
  }
}

TEST(Effects, OfALiquidLeaveTheOthersAlone) {
  const Json only_milk = {{"name", "fill_offset"}, {"fill_mm", 1}, {"liquid", "milk"}};
  EXPECT_EQ(value_of(kWater, only_milk, "height_mm", "centre"), value_of(kWater, nullptr, "height_mm", "centre"));
  EXPECT_GT(value_of(kMilk, only_milk, "height_mm", "centre"), value_of(kMilk, nullptr, "height_mm", "centre"));
}

}  // namespace
}  // namespace fathom
