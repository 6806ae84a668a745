// scenes/schema.json says what the parser accepts, key for key.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "core/error.h"
#include "core/json.h"
#include "sim/scene/setup.h"
#include "tests/core/expect_error.h"

namespace fathom {
namespace {

Json schema() { return read_json(std::filesystem::path(FATHOM_SCENES) / "schema.json"); }

/// A scene in which every kind of object of the schema stands.
Json full_scene() {
  return Json::parse(R"({
    "sensor": {"height_mm": 650, "pitch_deg": 60, "optics": {}, "noise": {"disparity": {}}, "pattern": {}, "matcher": {}, "unit": {},
               "believed": {"baseline_mm": 75, "focal_px": 570, "principal_px": [320, 240]}},
    "circumstances": {},
    "desk": {"glaze": {"roughness": 0.5}},
    "cups": [{"shape": {"height_mm": 80, "bottom_mm": 5, "inner_radius_mm": 30, "outer_radius_mm": 33, "handle": {}},
              "position_mm": [0, 400], "fill_mm": 20, "glaze": {"roughness": 0.1, "index": 1.5},
              "liquid": {"index": {"sellmeier_a": [0.75], "sellmeier_b_um2": [0.01], "range_nm": [400, 900]}, "ranges": {}},
              "surface": {"ripples": [{"wavelength_mm": 10, "amplitude_mm": 0.1}]}},
             {"shape": "mug", "position_mm": [200, 400], "fill_mm": 20, "liquid": {"name": "water"}},
             {"shape": "mug", "position_mm": [-200, 400], "fill_mm": 20, "liquid": {"index": {"dispersion": "water"}}},
             {"shape": {"height_mm": 80, "bottom_mm": 5, "inner_radius_mm": 30, "outer_radius_mm": 33,
                        "material": {"index": 1.51}}, "position_mm": [100, 400]}],
    "objects": [{"gltf": "box.glb"}, {"solid": {"box_mm": [10, 10, 10]}, "position_mm": [300, 400]}]
  })");
}

/// The keys that the parser offers when it meets an unknown one there: "…, choose from a, b, c".
std::set<std::string> keys_of_parser(const std::string& pointer) {
  Json scene = full_scene();
  scene[Json::json_pointer(pointer + "/no_such_key")] = 0;
  std::string message;
  try {
    setup_from_json(scene, "scene.json");
  } catch (const Error& problem) {
    message = problem.what();
  }
  std::set<std::string> keys;
  const std::string lead = "choose from ";
  std::size_t at = message.find(lead);
  if (at == std::string::npos) return keys;
  for (at += lead.size(); at < message.size();) {
    const std::size_t end = std::min(message.find(", ", at), message.size());
    keys.insert(message.substr(at, end - at));
    at = end + 2;
  }
  return keys;
}

std::set<std::string> keys_of_schema(const Json& object) {
  std::set<std::string> keys;
  for (const auto& [key, value] : object.at("properties").items()) keys.insert(key);
  return keys;
}

TEST(Schema, HasExactlyTheKeysOfTheParser) {
  const std::pair<const char*, const char*> places[] = {
      {"", ""},
      {"/sensor", "/$defs/sensor"},
      {"/circumstances", "/$defs/circumstances"},
      {"/sensor/believed", "/$defs/calibration"},
      {"/sensor/optics", "/$defs/optics"},
      {"/sensor/noise", "/$defs/noise"},
      {"/sensor/noise/disparity", "/$defs/disparity_noise"},
      {"/sensor/unit", "/$defs/unit"},
      {"/sensor/pattern", "/$defs/pattern"},
      {"/sensor/matcher", "/$defs/matcher"},
      {"/desk", "/$defs/desk"},
      {"/desk/glaze", "/$defs/glaze"},
      {"/cups/0", "/$defs/cup"},
      {"/cups/0/glaze", "/$defs/glaze"},
      {"/cups/0/shape", "/$defs/shape"},
      {"/cups/0/shape/handle", "/$defs/handle"},
      {"/cups/0/liquid", "/$defs/liquid"},
      {"/cups/0/surface", "/$defs/surface"},
      {"/cups/0/surface/ripples/0", "/$defs/ripple"},
      {"/cups/3/shape/material", "/$defs/liquid"},
      {"/cups/0/liquid/index", "/$defs/dispersion"},
      {"/cups/0/liquid/ranges", "/$defs/ranges"},
      {"/cups/1/liquid", "/$defs/changed_liquid"},
      {"/cups/2/liquid/index", "/$defs/water_like"},
      {"/objects/0", "/$defs/object"},
      {"/objects/1/solid", "/$defs/solid"},
  };
  EXPECT_NO_THROW(setup_from_json(full_scene(), "scene.json"));
  const Json whole = schema();
  for (const auto& [in_scene, in_schema] : places) {
    const Json& object = whole.at(Json::json_pointer(in_schema));
    EXPECT_EQ(keys_of_parser(in_scene), keys_of_schema(object)) << in_scene;
    EXPECT_EQ(object.at("additionalProperties"), false) << in_schema;
    for (const Json& required : object.value("required", Json::array())) {
      Json scene = full_scene();
      scene.at(Json::json_pointer(in_scene)).erase(required.get<std::string>());
      EXPECT_THROW(setup_from_json(scene, "scene.json"), Error) << in_scene << " without " << required;
    }
  }
}

TEST(Schema, WholeNumbersHaveTheRangesOfTheParser) {
  const Json whole = schema();
  for (const char* part : {"noise", "pattern", "matcher", "unit"})
    for (const auto& [key, rule] : whole.at("$defs").at(part).at("properties").items()) {
      if (rule.value("type", "") != "integer" || !rule.contains("maximum")) continue;
      const int low = rule.at("minimum"), high = rule.at("maximum");
      Json scene = full_scene();
      scene["sensor"][part][key] = high + 1;
      expect_error([&] { setup_from_json(scene, "scene.json"); },
                   {fmt::format("/sensor/{}/{}: must be a whole number from {} to {}, ", part, key, low, high)});
    }
}

void expect_references_resolve(const Json& part, const Json& whole) {
  if (part.is_object() && part.contains("$ref")) {
    const std::string target = part["$ref"];
    EXPECT_TRUE(whole.contains(Json::json_pointer(target.substr(1)))) << target;
  }
  if (part.is_structured())
    for (const Json& child : part) expect_references_resolve(child, whole);
}

TEST(Schema, RefersOnlyToItself) {
  const Json whole = schema();
  expect_references_resolve(whole, whole);
}

TEST(Schema, NoisePresetsAreTheParsers) {
  const Json whole = schema();
  for (const Json& name : whole.at(Json::json_pointer("/$defs/sensor/properties/noise/anyOf/0/enum"))) {
    Json scene = full_scene();
    scene["sensor"]["noise"] = name;
    EXPECT_NO_THROW(setup_from_json(scene, "scene.json")) << name;
  }
}

TEST(Schema, ShippedScenesAreRead) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(FATHOM_SCENES)) {
    if (entry.path().extension() != ".json" || entry.path().filename() == "schema.json") continue;
    EXPECT_NO_THROW(read_setup(entry.path())) << entry.path();
    ++scenes;
  }
  EXPECT_GT(scenes, 0);
}

}  // namespace
}  // namespace fathom
