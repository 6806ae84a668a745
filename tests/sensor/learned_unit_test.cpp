// A unit's learned bias in the simulator: unit.json and its image.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "core/files.h"
#include "core/image_file.h"
#include "core/json.h"
#include "sim/scene/resolved_scene.h"
#include "sim/sensor/capture.h"
#include "sim/sensor/depth.h"
#include "tests/core/expect_error.h"
#include "tests/core/temporary_folder.h"

namespace fathom {
namespace {

class LearnedUnit : public testing::Test {
 protected:
  /// A map of slow waves, of the reference 0.2 px and of the camera 0.1 px.
  void write_unit(int width = 640) const {
    Image<float> reference(width, 480), camera(width, 480);
    for (int y = 0; y < 480; ++y)
      for (int x = 0; x < width; ++x) {
        reference(x, y) = 0.2f * std::sin(0.012f * static_cast<float>(x) + 0.01f * static_cast<float>(y));
        camera(x, y) = 0.1f * std::cos(0.009f * static_cast<float>(x));
      }
    write_exr(folder_ / "map.exr", {{"camera_px", camera}, {"reference_px", reference}});
    write_text(folder_ / "unit.json", R"({"bias": {"image": "map.exr", "reference_at_px": 30}})");
  }

  fathom::Setup wall(const std::string& unit, double distance_mm = 1200.0) const {
    Json scene = Json::parse(R"({"sensor": {"model": "xtion_pro_live", "pitch_deg": 90, "quantization": "off",
                                 "noise": "off"}, "desk": {"size_mm": [9000, 9000]}})");
    scene["sensor"]["height_mm"] = distance_mm;
    if (!unit.empty()) scene["sensor"]["unit"] = unit;
    write_json(folder_ / "scene.json", scene);
    return read_setup(folder_ / "scene.json");
  }

  static Image<float> disparity(const fathom::Setup& setup, CaptureMode mode = CaptureMode::geometric) {
    return Camera(setup, mode, 4, 1).shoot(0).disparity_px;
  }

  TemporaryFolder folder_;
};

TEST_F(LearnedUnit, IsSeenWhereTheRememberedImageAndTheCameraHaveIt) {
  write_unit();
  const Image<float> reference = read_exr_channel(folder_ / "map.exr", "reference_px"),
                     camera = read_exr_channel(folder_ / "map.exr", "camera_px");
  for (const double distance_mm : {1200.0, 800.0}) {
    const fathom::Setup with = wall("unit.json", distance_mm);
    const Image<float> biased = disparity(with), exact = disparity(wall("", distance_mm));
    const SensorModel& sensor = with.rig.sensor;
    const double nearer = disparity_of_depth(sensor, distance_mm / 1000.0) - disparity_of_depth(sensor, 1.2);
    for (int y = 20; y < 480; y += 40)
      for (int x = 20; x < 600; x += 40) {
        const int met = x + 30 - static_cast<int>(std::lround(nearer));
        if (met < 1 || met > 638) continue;
        EXPECT_NEAR(biased(x, y) - exact(x, y), reference(met, y) + camera(x, y), 0.003) << x << ' ' << y;
      }
  }
}

TEST_F(LearnedUnit, MovesWhatTheMatcherFinds) {
  write_unit();
  const fathom::Setup setup = wall("unit.json");
  const Image<float> matched = disparity(setup, CaptureMode::photometric), added = disparity(setup);
  for (int y = 40; y < 440; y += 20)
    for (int x = 40; x < 600; x += 20) EXPECT_NEAR(matched(x, y), added(x, y), 0.02) << x << ' ' << y;
}

TEST_F(LearnedUnit, IsCopiedIntoTheRecordOfAScene) {
  write_unit();
  const fathom::Setup setup = wall("unit.json");
  const ResolvedScene resolved = resolved_scene(setup);
  ASSERT_EQ(resolved.files.size(), 2u);
  const std::filesystem::path elsewhere = folder_ / "elsewhere";
  for (const NamedFile& file : resolved.files) {
    std::filesystem::create_directories((elsewhere / file.name).parent_path());
    write_text(elsewhere / file.name, file.content);
  }
  write_json(elsewhere / "scene.json", resolved.scene);
  EXPECT_EQ(read_setup(elsewhere / "scene.json"), setup);
}

TEST_F(LearnedUnit, WhatIsWrongIsNamed) {
  write_unit();
  expect_error([&] { wall("../unit.json"); }, {"/sensor/unit: names '../unit.json', which lies outside"});
  expect_error([&] { wall("other.json"); }, {"other.json"});
  write_text(folder_ / "unit.json", R"({"bias": {"image": "../map.exr", "reference_at_px": 30}})");
  expect_error([&] { wall("unit.json"); }, {"/bias/image: names '../map.exr'"});
  write_unit(320);
  expect_error([&] { wall("unit.json"); }, {"map.exr: is 320 × 480 pixels, must be 640 × 480"});
}

}  // namespace
}  // namespace fathom
