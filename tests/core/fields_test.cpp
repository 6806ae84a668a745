#include "core/fields.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/core/expect_error.h"

namespace fathom {
namespace {

struct Arm {
  double length = 0.3;

  bool operator==(const Arm&) const = default;
};

struct Lamp {
  double power_w = 5.0;
  double width = 0.040;
  double turn = 0.0;
  int bulbs = 1;
  std::uint64_t serial = 0;
  Eigen::Vector2d place{0.0, 0.0};
  bool is_on = false;
  std::string colour = "white";
  Arm arm;

  bool operator==(const Lamp&) const = default;
};

std::span<const Field<Lamp>> lamp_fields() {
  static const Field<Lamp> fields[] = {
      {"power_w", &Lamp::power_w, {0.0, 100.0}, "of all bulbs", true},
      {"width_mm", Length{&Lamp::width}, kPositive, "of the shade"},
      {"turn_deg", Angle{&Lamp::turn}, {-180.0, 180.0}, "of the arm"},
      {"bulbs", &Lamp::bulbs, {1.0, 8.0}, "in the shade"},
      {"serial", &Lamp::serial, {0.0, 1000.0}, "of this lamp"},
      {"place_px", &Lamp::place, {-10.0, 10.0}, "on the plan"},
      {"switch",
       Choice<Lamp>{{"off", "on"},
                    [](const Lamp& lamp) { return lamp.is_on ? std::size_t{1} : std::size_t{0}; },
                    [](Lamp& lamp, std::size_t choice) { lamp.is_on = choice == 1; }},
       "whether it shines"},
      {"colour",
       Part<Lamp>{[](const JsonReader& json, Lamp& lamp) { lamp.colour = json.text(); },
                  [](const Lamp& lamp) { return lamp.colour == "white" ? Json() : Json(lamp.colour); },
                  R"({"type": "string"})", "a text"},
       "of the light"},
      {&Lamp::arm, {"arm_mm", Length{&Arm::length}, {0.0, 2000.0}, "of the arm"}}};
  return fields;
}

Lamp lamp_from(const std::string& text) {
  const Json json = Json::parse(text);
  Lamp lamp;
  read_fields(JsonReader(json, "lamp.json"), lamp_fields(), lamp);
  return lamp;
}

TEST(Fields, WhatIsWrittenReadsBackToTheLastBit) {
  Lamp lamp{.power_w = 7.1,
            .width = 0.033,
            .turn = 0.5,
            .bulbs = 3,
            .serial = 9,
            .place = {1.5, -2.0},
            .is_on = true,
            .colour = "red",
            .arm = {0.7}};
  const Lamp again = lamp_from(json_from_fields(lamp_fields(), lamp).dump());
  EXPECT_NEAR(again.turn, lamp.turn, 1e-15);
  lamp.turn = again.turn;
  EXPECT_EQ(again, lamp);
}

TEST(Fields, AbsentKeysLeaveWhatIsThereAndNullIsNotWritten) {
  EXPECT_EQ(lamp_from(R"({"power_w": 5})"), Lamp{});
  EXPECT_FALSE(json_from_fields(lamp_fields(), Lamp{}).contains("colour"));
}

TEST(Fields, ErrorsSayFilePlaceAndWhatIsAllowed) {
  const auto refuses = [](const std::string& text, std::initializer_list<std::string> parts) {
    expect_error([&] { lamp_from(text); }, parts);
  };
  refuses(R"({"bulbs": 2})", {"lamp.json", "/power_w: is missing"});
  refuses(R"({"power_w": 101})", {"/power_w: must be a number from 0 to 100, got 101"});
  refuses(R"({"power_w": 5, "bulbs": 2.5})", {"/bulbs: must be a whole number from 1 to 8, got 2.5"});
  refuses(R"({"power_w": 5, "switch": "dim"})", {"/switch:", "dim", "off, on"});
  refuses(R"({"power_w": 5, "arm_mm": -1})", {"/arm_mm: must be a number from 0 to 2000, got -1"});
  refuses(R"({"power_w": 5, "bulb": 2})", {"/bulb:", "bulbs"});
}

TEST(Fields, RowsSayWhatIsAllowedWithoutTheKeyAndAsASchema) {
  const std::vector<KeyRow> rows = key_rows(lamp_fields(), Lamp{});
  ASSERT_EQ(rows.size(), 9u);
  EXPECT_TRUE(rows[0].is_required);
  EXPECT_TRUE(rows[0].standard.is_null());
  EXPECT_EQ(rows[0].schema.dump(), R"({"type":"number","minimum":0,"maximum":100,"description":"of all bulbs"})");
  EXPECT_EQ(rows[1].allowed, "above 0");
  EXPECT_EQ(rows[1].standard, 40.0);
  EXPECT_EQ(rows[3].allowed, "1 to 8");
  EXPECT_EQ(rows[6].allowed, "`off`, `on`");
  EXPECT_EQ(rows[6].schema.at("enum"), Json({"off", "on"}));
  EXPECT_EQ(rows[8].key, "arm_mm");
  EXPECT_EQ(rows[8].allowed, "0 to 2000");
  EXPECT_EQ(rows[8].standard, 300.0);
}

}  // namespace
}  // namespace fathom
