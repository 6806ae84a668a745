// Random desks: the same for the same seed, everything where it was asked for, and errors that say what is allowed.
#include "sim/scene/clutter.h"
#include "core/json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/units.h"
#include "sim/scene/cup.h"
#include "sim/scene/scene.h"
#include "sim/scene/setup.h"
#include "tests/core/expect_error.h"
#include "tests/core/temporary_folder.h"

namespace fathom {
namespace clutter_test {

constexpr double kRounding = 1e-6;  // [m] of places in scene files, and of hulls that were simplified alike

Json shipped_spec() { return read_json(std::filesystem::path(FATHOM_SCENES) / "clutter" / "desk.json"); }

ClutterSpec spec_of(const Json& json) {
  const TemporaryFolder folder;
  write_json(folder / "spec.json", json);
  return read_clutter_spec(folder / "spec.json");
}

struct Laid {
  std::vector<Footprint> cups, objects;
  std::vector<Eigen::Vector2d> cup_places, object_middles;
};

Laid laid(const Json& scene) {
  Laid result;
  const Setup setup = setup_from_json(scene, "scene.json");
  for (const Cup& cup : setup.scene.cups) {
    result.cups.emplace_back(cup_parts(cup));
    result.cup_places.push_back(cup.position);
  }
  for (const Object& object : setup.scene.objects) {
    result.objects.emplace_back(object_parts(object));
    result.object_middles.emplace_back(object.world_from_object.translation().head<2>());
  }
  return result;
}

TEST(Clutter, IsTheSameForTheSameSeedAndNumberOnly) {
  const ClutterSpec spec = spec_of(shipped_spec());
  EXPECT_EQ(random_scene(spec, 1, 7), random_scene(spec, 1, 7));
  EXPECT_NE(random_scene(spec, 1, 7), random_scene(spec, 1, 8));
  EXPECT_NE(random_scene(spec, 1, 7), random_scene(spec, 2, 7));
}

TEST(Clutter, ThingsStandInTheRegionWithTheirGaps) {
  Json json = shipped_spec();
  json["touching"] = json["occluding"] = 0.0;
  json["cups"]["number"] = {1, 3};
  const ClutterSpec spec = spec_of(json);
  for (std::uint64_t number = 0; number < 20; ++number) {
    const Laid desk = laid(random_scene(spec, 1, number));
    EXPECT_GE(desk.cups.size(), 1u);
    EXPECT_LE(desk.cups.size(), 3u);
    EXPECT_GE(desk.objects.size(), 3u);
    EXPECT_LE(desk.objects.size(), 6u);
    std::vector<Footprint> all = desk.cups;
    all.insert(all.end(), desk.objects.begin(), desk.objects.end());
    for (std::size_t a = 0; a < all.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) EXPECT_GE(all[a].distance(all[b]), spec.gap - kRounding) << number;
    for (const Eigen::Vector2d& place : desk.cup_places) EXPECT_TRUE(spec.region.contains(place)) << number;
  }
}

TEST(Clutter, WhatTouchesACupLeavesAtMostTwoMillimetres) {
  Json json = shipped_spec();
  json["touching"] = 1.0;
  json["occluding"] = 0.0;
  json["objects"]["number"] = {2, 2};
  const ClutterSpec spec = spec_of(json);
  for (std::uint64_t number = 0; number < 20; ++number) {
    const Laid desk = laid(random_scene(spec, 1, number));
    for (const Footprint& object : desk.objects) {
      constexpr double kBisected = 1e-5;
      EXPECT_LE(object.distance(desk.cups[0]), 0.002 + kBisected + kRounding) << number;
    }
  }
}

TEST(Clutter, WhatOccludesACupStandsBetweenItAndTheSensor) {
  Json json = shipped_spec();
  json["touching"] = 0.0;
  json["occluding"] = 1.0;
  json["objects"]["number"] = {1, 1};
  const ClutterSpec spec = spec_of(json);
  for (std::uint64_t number = 0; number < 20; ++number) {
    const Laid desk = laid(random_scene(spec, 1, number));
    const double gap = desk.objects[0].distance(desk.cups[0]);
    EXPECT_GE(gap, 0.020 - 1e-5 - kRounding) << number;
    EXPECT_LE(gap, 0.080 + 1e-5 + kRounding) << number;
    const Eigen::Vector2d towards = desk.object_middles[0] - desk.cup_places[0], to_sensor = -desk.cup_places[0];
    EXPECT_GE(towards.normalized().dot(to_sensor.normalized()), std::cos(std::numbers::pi / 12.0) - kRounding);
  }
}

/// Of desks 0 to 39.
int filled_cups(const Json& spec_json) {
  const ClutterSpec spec = spec_of(spec_json);
  int filled = 0;
  for (std::uint64_t number = 0; number < 40; ++number) {
    const auto setup = setup_from_json(random_scene(spec, 1, number), "scene.json");
    filled += setup.scene.cups.at(0).filling.has_value();
  }
  return filled;
}

TEST(Clutter, FillsItsCupsButTheShareThatStaysEmpty) {
  const Json water = {{"liquid", "water"}, {"fill_mm", 20}};
  Json drawn = shipped_spec(), shared = drawn, none = drawn;
  drawn["fillings"] = {Json::object(), water};
  shared["fillings"] = none["fillings"] = Json::array({water});
  EXPECT_EQ(filled_cups(shared), 40);
  shared["empty"] = 0.5, none["empty"] = 1.0;
  EXPECT_EQ(filled_cups(none), 0);
  for (const Json& half : {drawn, shared}) {
    // Binomial(40, ½) stays from 8 to 32 but for 1 in 10,000 seeds.
    EXPECT_GE(filled_cups(half), 8);
    EXPECT_LE(filled_cups(half), 32);
  }
}

TEST(Clutter, WrongSpecsSayWhatIsWrong) {
  const auto with = [](const char* pointer, const char* value) {
    Json json = shipped_spec();
    json[Json::json_pointer(pointer)] = Json::parse(value);
    return json;
  };
  const std::tuple<const char*, const char*, const char*> refusals[] = {
      {"/cup", "{}", "unknown key 'cup'"},
      {"/cups/number", "[2, 1]", "/cups/number: must not end below its start"},
      {"/cups/kinds", "[]", "/cups/kinds: must hold at least one"},
      {"/cups/kinds/0/position_mm", "[0, 0]", "/cups/kinds/0/position_mm: cannot stand here"},
      {"/cups/kinds/0/shape", "\"glass\"", "/cups/kinds/0/shape: unknown cup shape 'glass'"},
      {"/objects/kinds/0/solid", "\"cann\"", "/objects/kinds/0/solid: unknown solid 'cann'"},
      {"/fillings", R"([{"liquid": "water"}])", "/fillings/0: must have both liquid and fill_mm"},
      {"/region_mm/x_mm", "[1, 0]", "/region_mm/x_mm: must not end below its start"},
      {"/occluding", "0.99", "/occluding: must leave touching + occluding at most 1"},
      {"/desk", "null", "/desk: is what things stand on"},
      {"/sensor/height_mm", "-1", "/sensor/height_mm: must be"},
  };
  for (const auto& [pointer, value, message] : refusals)
    expect_error([&, p = pointer, v = value] { spec_of(with(p, v)); }, {"spec.json: ", message});
  const ClutterSpec crowded = spec_of(with("/objects/number", "[30, 30]"));
  expect_error([&] { random_scene(crowded, 1, 0); }, {"scene 0: has no room for up to 1 cups and 30 objects"});
}

}  // namespace clutter_test
}  // namespace fathom
