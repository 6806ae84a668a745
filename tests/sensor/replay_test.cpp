// What a capture writes of its set-up gives the same set-up again: for every sensor and every effect, bit for bit.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/json.h"
#include "core/library.h"
#include "sim/effects/effects_json.h"
#include "sim/effects/registry.h"
#include "sim/scene/resolved_scene.h"
#include "sim/sensor/capture.h"
#include "sim/sensor/depth.h"

namespace fathom {
namespace {

/// Everything that effects may change, before a sensor of a sixteenth of the pixels.
Json scene_of(const std::string& sensor) {
  Json scene = Json::parse(R"({
    "sensor": {"height_mm": 650, "aim_mm": [20, 300, 0], "roll_deg": 3, "ir_size_px": [320, 256],
               "depth_size_px": [160, 120], "focal_px": 142.58, "depth_cut_mm": 0, "optics": {"f_number": 3.1},
               "matcher": {"disparity_min_px": -8, "disparity_max_px": 20}},
    "cups": [{"shape": "paper_cup", "position_mm": [0, 300], "liquid": {"name": "water", "temperature_c": 25}, "fill_mm": 30},
             {"shape": "mug", "position_mm": [120, 330], "yaw_deg": 30, "liquid": "skim_milk", "fill_ml": 80},
             {"position_mm": [-110, 330], "liquid": {"name": "intralipid_20", "dilution": 0.01}, "fill_mm": 11.1,
              "surface": {"tilt_deg": 1, "ripples": [{"wavelength_mm": 15, "amplitude_mm": 0.1}]},
              "shape": {"height_mm": 80, "bottom_mm": 5, "inner_radius_mm": 30, "outer_radius_mm": 33, "material": "pet"}}],
    "objects": [{"solid": "can", "position_mm": [100, 500], "rotation_deg": [0, 90, 10]},
                {"solid": {"cup": "tapered_cup"}, "position_mm": [-100, 500], "rotation_deg": [180, 0, 0]}],
    "circumstances": {"time_s": 600, "stood_s": 3600, "liquids": ["water", "skim_milk"]}})");
  scene["sensor"]["model"] = sensor;
  return scene;
}

/// An effect a typical departure away from where it is absent.
Json typical(const Effect& effect) {
  Json json = {{"name", std::string(effect.id)}};
  for (const EffectParameter& parameter : effect.parameters)
    json[std::string(parameter.name)] = std::min(parameter.nominal + parameter.scale, parameter.upper);
  return json;
}

Setup shot_of(const Json& scene) { return with_effects(setup_from_json(scene, "scene.json")); }

/// The scene as a file would hold it, read by itself.
Setup read_again(const Setup& shot) { return shot_of(Json::parse(Json(resolved_scene(shot).scene).dump())); }

Frame geometric_frame(const Setup& setup) { return Camera(setup, CaptureMode::geometric, 1, 1).shoot(0); }

TEST(Replay, EverySensorWithEveryEffectIsReadBackAsItWasShot) {
  for (const std::string& sensor : library_names("sensors")) {
    const fathom::Setup without = shot_of(scene_of(sensor));
    EXPECT_EQ(read_again(without), without) << sensor;
    for (const Effect& effect : effect_registry()) {
      SCOPED_TRACE(fmt::format("{}, {}", sensor, effect.id));
      Json scene = scene_of(sensor);
      scene["effects"].push_back(typical(effect));
      const fathom::Setup shot = shot_of(scene), again = read_again(shot);
      EXPECT_FALSE(shot == without);  // the effect is there
      EXPECT_TRUE(again == shot);
      const Json record = Json::parse(json_from_rig(shot.rig).dump());
      EXPECT_TRUE(rig_from_json(JsonReader(record, "run.json")) == shot.rig) << record.dump();
    }
  }
}

TEST(Replay, GivesTheSameBytesOfDepth) {
  for (const std::string& sensor : library_names("sensors"))
    for (const Effect& effect : effect_registry()) {
      SCOPED_TRACE(fmt::format("{}, {}", sensor, effect.id));
      Json scene = scene_of(sensor);
      scene["cups"].erase(2);  // light through a clear wall takes a second
      scene["effects"].push_back(typical(effect));
      const fathom::Setup shot = shot_of(scene), again = read_again(shot);
      const Frame first = geometric_frame(shot), second = geometric_frame(again);
      EXPECT_TRUE(std::ranges::equal(first.disparity_px.pixels(), second.disparity_px.pixels()));
      EXPECT_TRUE(std::ranges::equal(first.depth.pixels(), second.depth.pixels()));
      if (again.processing.colour_view) continue;
      // Who has the disparities alone makes the same depths of them.
      const Image<float> replayed = depth_image(again.rig.sensor, first.disparity_px, again.rig.sensor.law.cut);
      EXPECT_TRUE(std::ranges::equal(replayed.pixels(), first.depth.pixels()));
    }
}

/// The paths of all numbers.
void collect_numbers(const Json& json, const std::string& at, std::vector<Json::json_pointer>& numbers) {
  if (json.is_number()) numbers.emplace_back(at);
  if (json.is_object())
    for (const auto& [key, value] : json.items()) collect_numbers(value, at + "/" + key, numbers);
  if (json.is_array())
    for (std::size_t i = 0; i < json.size(); ++i) collect_numbers(json[i], fmt::format("{}/{}", at, i), numbers);
}

/// Values beside a number, which may not all be allowed.
std::vector<Json> beside(const Json& number) {
  if (number.is_number_float()) {
    const double value = number.get<double>(), little = value == 0.0 ? 1e-9 : 1e-9 * value;
    return {value + little, value - little};
  }
  const auto value = number.get<std::int64_t>();
  return {value + 1, value - 1, value + 2, value - 2};
}

/// Whether a reader notices that each number of `json` changes, by what it makes of it or by refusing it.
template <class Read>
void expect_every_number_counts(const Json& json, Read read) {
  const auto made = read(json);
  std::vector<Json::json_pointer> numbers;
  collect_numbers(json, "", numbers);
  EXPECT_GT(numbers.size(), 60u);
  for (const Json::json_pointer& at : numbers)
    for (const Json& value : beside(json.at(at))) {
      Json changed = json;
      changed[at] = value;
      try {
        EXPECT_FALSE(read(changed) == made) << at.to_string() << " " << value;
      } catch (const Error&) {
        continue;
      }
    }
}

/// Nothing at its default.
Json eventful_scene() {
  Json scene = scene_of("xtion_pro_live_device");
  for (const Effect& effect : effect_registry()) scene["effects"].push_back(typical(effect));
  return scene;
}

TEST(Replay, EveryNumberOfASensorsRecordCounts) {
  const Rig rig = shot_of(eventful_scene()).rig;
  ASSERT_TRUE(rig.sensor.believed);
  expect_every_number_counts(json_from_rig(rig),
                             [](const Json& json) { return rig_from_json(JsonReader(json, "run.json")); });
}

TEST(Replay, EveryNumberOfAResolvedSceneCounts) {
  Json scene = scene_of("xtion_pro_live");
  for (const char* effect : {"ripples", "subsurface_scattering", "baseline"})
    scene["effects"].push_back(typical(*find_effect(effect)));
  // A cup of profiles, for whom each point counts; a mug's handle counts beside it.
  scene["cups"].push_back(Json::parse(R"({"position_mm": [0, 600], "shape": {
      "inner_profile_mm": [[0, 7], [30, 8], [40, 87]], "outer_profile_mm": [[0, 0], [35, 0], [43, 87]]}})"));
  expect_every_number_counts(resolved_scene(shot_of(scene)).scene, shot_of);
}

TEST(Replay, AResolvedSceneNamesNoLibrary) {
  const Json scene = resolved_scene(shot_of(scene_of("kinect_v1_device"))).scene;
  EXPECT_FALSE(scene["sensor"].contains("model"));
  for (const Json& cup : scene["cups"]) {
    EXPECT_TRUE(cup["shape"].is_object());
    EXPECT_TRUE(cup["liquid"].contains("index") || cup["liquid"]["of"].contains("index"));
  }
  EXPECT_TRUE(scene["cups"][2]["shape"]["material"].is_object());
  for (const Json& object : scene["objects"]) EXPECT_TRUE(object["solid"].is_object());
  EXPECT_TRUE(scene["objects"][1]["solid"]["cup"].is_object());
  for (const Json& liquid : scene["circumstances"]["liquids"]) EXPECT_TRUE(liquid.is_object());
}

TEST(Replay, AResolvedSceneIsItsOwn) {
  Json scene = scene_of("xtion_pro_live");
  scene["effects"].push_back(typical(*find_effect("fill_scale")));
  const Json resolved = resolved_scene(shot_of(scene)).scene;
  EXPECT_EQ(Json(resolved_scene(shot_of(resolved)).scene), resolved);
}

}  // namespace
}  // namespace fathom
