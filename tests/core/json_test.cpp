#include "core/json.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/files.h"
#include "tests/core/expect_error.h"
#include "tests/core/temporary_folder.h"

namespace fathom {
namespace {

const Json kScene = Json::parse(R"({
  "cups": [{"liquid": "wtaer", "fill_mm": -3, "wall_mm": 2}],
  "sensor": {"aim_mm": [0, 400], "on": 1, "width": 2.5, "name": 7, "height_mm": 1e300}
})");
const JsonReader kReader(kScene, "scene.json");

TEST(Json, UnknownKeyNamesFilePathAndChoices) {
  expect_error(
      [] {
        kReader.at("cups").items().at(0).allow_only({"liquid", "fill_mm"});
      },
      {"scene.json: /cups/0/wall_mm: ", "unknown key 'wall_mm'", "choose from liquid, fill_mm"});
}

TEST(Json, UnknownNameNamesFilePathAndChoices) {
  const std::vector<std::string> choices{"milk_tea", "water"};
  expect_error(
      [&] { kReader.at("cups").items().at(0).at("liquid").choice(choices, "liquid"); },
      {"scene.json: /cups/0/liquid: ", "unknown liquid 'wtaer', choose from milk_tea, water; did you mean 'water'?"});
  const Json tilt = "tilt";
  const std::vector<std::string> effects{"sensor_height", "surface_tilt"};
  expect_error([&] { JsonReader(tilt, "f").choice(effects, "effect"); }, {"did you mean 'surface_tilt'?"});
  const Json water = "water";
  EXPECT_EQ(JsonReader(water, "f").choice(choices, "liquid"), 1u);
}

TEST(Json, MissingKeyNamesFileAndPath) {
  expect_error([] { kReader.at("sensor").number("pitch_deg"); }, {"scene.json: /sensor/pitch_deg: is missing"});
}

TEST(Json, NumberOutsideItsRangeNamesTheRange) {
  const JsonReader fill = kReader.at("cups").items().at(0).at("fill_mm");
  expect_error([&] { fill.number(kNonNegative); }, {"scene.json: /cups/0/fill_mm: ", "of at least 0", "got -3"});
  expect_error([&] { fill.number(kPositive); }, {"above 0"});
  expect_error([&] { fill.number({0.0, 87.0, true}); }, {"above 0 and at most 87"});
  EXPECT_EQ(fill.number({-3.0, 0.0}), -3.0);
}

TEST(Json, WrongTypeNamesWhatIsNeededAndWhatWasGot) {
  const JsonReader sensor = kReader.at("sensor");
  expect_error([&] { sensor.number("aim_mm"); }, {"/sensor/aim_mm: must be a number, got [0,400]"});
  expect_error([&] { sensor.text("name"); }, {"/sensor/name: must be a text, got 7"});
  expect_error([&] { sensor.at("width").integer(1, 4); },
               {"/sensor/width: must be a whole number from 1 to 4, got 2.5"});
  expect_error([&] { sensor.at("name").integer(1, 4); }, {"from 1 to 4, got 7"});
  expect_error([&] { sensor.at("aim_mm").vector3(); }, {"/sensor/aim_mm: must be a list of 3 numbers"});
  expect_error([&] { sensor.items(); }, {"/sensor: must be a list"});
  expect_error([&] { sensor.at("name").at("x"); }, {"/sensor/name: must be an object"});
  EXPECT_EQ(sensor.at("aim_mm").vector2(), Eigen::Vector2d(0.0, 400.0));
}

TEST(Json, WholeNumbersBeyondIntAreOutOfRangeNotWrappedRound) {
  for (const char* text : {"18446744073709551615", "4294967297", "-4294967297"}) {
    const Json value = Json::parse(text);
    expect_error([&] { JsonReader(value, "f").integer(-10, 10); }, {"from -10 to 10", text});
  }
}

TEST(Json, SyntaxErrorNamesLineAndColumn) {
  const TemporaryFolder folder;
  write_text(folder / "broken.json", "{\n  \"a\": 1,\n  \"b\" 2\n}\n");
  expect_error([&] { read_json(folder / "broken.json"); }, {(folder / "broken.json").string(), "line 3, column 7"});
  write_text(folder / "empty.json", "");
  expect_error([&] { read_json(folder / "empty.json"); }, {"line 1, column 1"});
  write_text(folder / "latin1.json", "{\"a\": \"\xe9\"}");
  expect_error([&] { read_json(folder / "latin1.json"); }, {"line 1, column"});
}

TEST(Json, NumberBeyondDoublePrecisionNamesTheFile) {
  const TemporaryFolder folder;
  write_text(folder / "huge.json", "{\"a\": 1e400}");
  expect_error([&] { read_json(folder / "huge.json"); }, {(folder / "huge.json").string(), "too large"});
}

TEST(Json, ComesBackFromItsFileInTheSameOrder) {
  const TemporaryFolder folder;
  write_json(folder / "scene.json", kScene);
  EXPECT_EQ(read_json(folder / "scene.json").dump(), kScene.dump());
}

TEST(Json, AWrongFileIsToldWhereAndWhatWasExpected) {
  const TemporaryFolder folder;
  const auto expect = [&](const char* text, const char* words) {
    write_text(folder / "scene.json", text);
    expect_error([&] { read_json(folder / "scene.json"); }, {words});
  };
  expect("{\"a\": 1\n \"b\": 2}",
         "line 2, column 4: is not valid JSON: unexpected string literal; expected ',' or '}'");
  expect("{\"a\": 1,}", "line 1, column 9: is not valid JSON: unexpected '}'; expected string literal");
  expect("{\"a\": tru}", "line 1, column 10: is not valid JSON: invalid literal");
}

TEST(Json, ANulDoesNotEndAFile) {
  const TemporaryFolder folder;
  for (const std::string& text : {std::string("{}\0", 3), std::string("{}\0]", 4), std::string("{\"a\0\": 1}", 9)}) {
    write_text(folder / "scene.json", text);
    expect_error([&] { read_json(folder / "scene.json"); }, {"scene.json: holds a NUL, which is not valid JSON"});
  }
}

TEST(Json, AnErrorAboutANameWithANulSaysWhatIsWrong) {
  const Json json = Json::parse(R"({"a\u0000b": 1})");
  expect_error([&] { JsonReader(json, "scene.json").allow_only({"a"}); },
               {R"(scene.json: /a\u0000b: unknown key 'a\u0000b', choose from a)"});
}

TEST(Json, AnObjectOfTooManyKeysIsRefusedAtOnce) {
  const TemporaryFolder folder;
  std::string text = "{";
  for (int key = 0; key < 30'000; ++key) text += fmt::format("\"{}\":0,", key);
  text.back() = '}';
  write_text(folder / "many.json", text);
  expect_error([&] { read_json(folder / "many.json"); },
               {"many.json: has objects of so many keys that reading them would take minutes"});
}

}  // namespace
}  // namespace fathom
