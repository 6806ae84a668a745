// Geometric captures show liquids that scatter as photometric ones do.
#include "sim/sensor/turbid_part.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "core/estimate.h"
#include "sim/sensor/capture.h"
#include "sim/sensor/spread_dots.h"
#include "tests/render/scenes.h"

namespace fathom {
namespace {

TEST(SpreadDots, AreTheSumOfTheirLights) {
  const Pattern pattern(PatternModel{}, 2.0);
  const BlurredPattern blurred(pattern);
  // Some sharp and near, others blurred and far, as walks have them.
  Rng draw(1, 2);
  std::vector<SpreadLight> lights;
  for (int i = 0; i < 400; ++i) {
    const double far = 0.2 * std::exp(6.0 * draw.uniform()), around = 6.283 * draw.uniform();
    lights.push_back({static_cast<float>(far * std::cos(around)), static_cast<float>(far * std::sin(around)),
                      static_cast<float>(1.0 / (1.0 + far)), static_cast<float>(0.25 * far)});
  }
  const Eigen::Vector2d low(400.0, 200.0), high(404.0, 206.0);
  const SpreadDots dots(blurred, lights, low, high);
  double squares = 0.0, apart = 0.0, mean = 0.0;
  constexpr int kPlaces = 500;
  std::vector<double> exact;
  for (int i = 0; i < kPlaces; ++i) {
    const Eigen::Vector2d way = low + Eigen::Vector2d(draw.uniform(), draw.uniform()).cwiseProduct(high - low);
    double sum = 0.0;
    for (const SpreadLight& light : lights)
      sum += light.dn * blurred.intensity(way + Eigen::Vector2d(light.dx_steps, light.dy_steps), light.blur_steps);
    exact.push_back(sum), mean += sum / kPlaces;
    apart += std::pow(dots(way) - sum, 2.0) / kPlaces;
  }
  for (const double sum : exact) squares += std::pow(sum - mean, 2.0) / kPlaces;
  EXPECT_LT(std::sqrt(apart), 0.04 * std::sqrt(squares));  // of the dots' deviation
}

Setup filled_cup(const char* liquid, const std::string& sensor, double off_mm = 0.0, double aim_mm = 300.0) {
  return setup_from_json(Json::parse(fmt::format(
                             R"({{"sensor": {{"height_mm": 650, "aim_mm": [0, {}, 0]{}}},
        "cups": [{{"shape": "paper_cup", "position_mm": [{}, {}], "liquid": "{}", "fill_mm": 40}}]}})",
                             aim_mm, sensor, off_mm, 300.0 + 0.6 * off_mm, liquid)),
                         "test");
}

class PartOfAnImage : public testing::TestWithParam<std::pair<const char*, double>> {};

TEST_P(PartOfAnImage, IsMatchedAsTheWholeImageIs) {
  const auto& [model, aim_mm] = GetParam();
  const LitScene scene(filled_cup("milk_tea", fmt::format(R"(, "model": "{}", "noise": "off")", model), 0.0, aim_mm));
  const SensorModel& sensor = scene.rig.sensor;
  const Pattern pattern(sensor.pattern, sensor.ir_scale());
  CaptureStatistics statistics;
  const auto matched = [&](const Rig& rig) {
    const auto reference = std::make_shared<const Reference>(remember(rig.sensor, pattern, 2));
    return ImagedView(scene.projector, rig, pattern, reference, 2, LightModel::direct, 1, statistics)
        .shoot(0, statistics)
        .disparity_px;
  };
  const Image<TruePixel> truth = trace_truth(scene.projector, scene.rig);
  const ImagePart part = parts_with_liquids(truth, sensor).begin()->second;
  Rig without_errors = scene.rig;
  without_errors.sensor.unit = {};
  const Image<float> whole = matched(without_errors);
  const Image<float> alone = matched({sensor_of_part(sensor, part), scene.rig.world_from_camera});
  int compared = 0;
  for (int y = 0; y < part.height; ++y)
    for (int x = 0; x < part.width; ++x) {
      if (truth(part.left + x, part.top + y).path != PathKind::scattered) continue;
      ASSERT_NEAR(alone(x, y), whole(part.left + x, part.top + y), 1e-3) << x << ' ' << y;
      ++compared;
    }
  EXPECT_GT(compared, 500);
}

// In the middle, and cut by the image's upper side.
INSTANTIATE_TEST_SUITE_P(TurbidPart, PartOfAnImage,
                         testing::Values(std::pair("xtion_pro_live", 300.0), std::pair("xtion_pro_live", 40.0),
                                         std::pair("xtion_pro_live_device", 300.0),
                                         std::pair("xtion_pro_live_device", 40.0)));

TEST(TurbidPart, HasSpeckleOfItsOwn) {
  const SensorModel sensor;
  const auto serial = [&](const ImagePart& part) { return sensor_of_part(sensor, part).unit.serial; };
  EXPECT_EQ(serial({160, 90, 80, 60}), serial({160, 90, 80, 60}));
  EXPECT_NE(serial({160, 90, 80, 60}), serial({320, 90, 80, 60}));
}

struct SeenLiquid {
  double matched = 0.0;    ///< share of its pixels
  double nearer_px = 0.0;  ///< mean disparity more than that of its surface
};

SeenLiquid seen_liquid(const Setup& setup, CaptureMode mode, std::uint64_t seed,
                       std::optional<LightModel> light = std::nullopt) {
  constexpr double kWrong_px = 1.5;
  Camera camera(setup, mode, kDefaultSamplesPerPixel, seed, light);
  const Frame frame = camera.shoot(0);
  const SensorModel& sensor = camera.setup().rig.sensor;
  int seen = 0, matched = 0;
  Mean nearer;
  for (std::size_t i = 0; i < camera.truth().size(); ++i) {
    const TruePixel& pixel = camera.truth().pixels()[i];
    if (pixel.path != PathKind::scattered || !pixel.apparent_depth) continue;
    ++seen;
    const double disparity = frame.disparity_px.pixels()[i];
    if (disparity <= 0.0) continue;
    ++matched;
    const double off = disparity - sensor.focal_px * sensor.baseline / *pixel.apparent_depth;
    if (std::fabs(off) < kWrong_px) nearer.add(off);
  }
  return {static_cast<double>(matched) / seen, nearer.estimate().value};
}

// The sensor looks at the cup and little else: what is compared is the cup, and this takes a fifth of the time.
constexpr const char* kAroundTheCup =
    R"(, "model": "xtion_pro_live", "ir_size_px": [320, 240], "depth_size_px": [160, 120], "principal_px": [80, 60])";

TEST(TurbidPart, IsMatchedAndLowAsInPhotometricFrames) {
  constexpr int kPlaces = 4;
  for (const char* liquid : {"milk_tea", "orange_juice"}) {
    Mean more, nearer;
    for (int place = 0; place < kPlaces; ++place) {
      const auto setup = filled_cup(liquid, kAroundTheCup, 1.7 * place);
      const SeenLiquid geometric = seen_liquid(setup, CaptureMode::geometric, place + 1);
      const SeenLiquid photometric = seen_liquid(setup, CaptureMode::photometric, place + 1);
      more.add(geometric.matched - photometric.matched), nearer.add(geometric.nearer_px - photometric.nearer_px);
    }
    // The seeds are fixed. Another place of the cup changes the share by about 0.04, the disparity by 0.05 px.
    EXPECT_NEAR(more.estimate().value, 0.0, 0.08) << liquid;
    EXPECT_NEAR(nearer.estimate().value, 0.0, 0.08) << liquid;
  }
}

TEST(TurbidPart, IsAnOpaqueSurfaceInDirectLight) {
  const SeenLiquid opaque = seen_liquid(filled_cup("milk_tea", R"(, "model": "xtion_pro_live", "noise": "off")"),
                                        CaptureMode::geometric, 1, LightModel::direct);
  EXPECT_EQ(opaque.matched, 1.0);
  EXPECT_NEAR(opaque.nearer_px, 0.0, 1e-4);
  Camera camera(filled_cup("milk_tea", R"(, "model": "xtion_pro_live")"), CaptureMode::geometric, 1, 1,
                LightModel::direct);
  EXPECT_EQ(camera.light(), LightModel::direct);
}

}  // namespace
}  // namespace fathom
