// What a cup's profiles say of it.
#include "core/cup_profile.h"

#include <gtest/gtest.h>

#include "core/json.h"
#include "core/units.h"

#include "tests/core/expect_error.h"

namespace fathom {
namespace {

CupProfile read(const char* text) {
  const Json json = Json::parse(text);
  return cup_profile_from_json(JsonReader(json, "cup.json"));
}

TEST(CupProfile, RadiiAreThoseAtTheHeightThatIsLookedAt) {
  const CupProfile cup = read(R"({"inner_profile_mm": [[0, 4], [26, 4], [38, 90]],
                                  "outer_profile_mm": [[0, 0], [27, 0], [39, 90]]})");
  EXPECT_DOUBLE_EQ(cup.height(), 0.090);
  EXPECT_DOUBLE_EQ(cup.bottom(), 0.004);
  EXPECT_DOUBLE_EQ(cup.outer_radius(0.0), 0.027);
  EXPECT_DOUBLE_EQ(cup.outer_radius(0.045), 0.033);
  EXPECT_DOUBLE_EQ(cup.inner_radius(0.047), 0.032);
  EXPECT_DOUBLE_EQ(cup.narrowest(), 0.026);
  EXPECT_DOUBLE_EQ(cup.widest(), 0.039);
  EXPECT_FALSE(cup.is_straight());
}

TEST(CupProfile, OfFourLengthsIsStraight) {
  const CupProfile cup = read(R"({"height_mm": 87, "bottom_mm": 7, "inner_radius_mm": 40, "outer_radius_mm": 43})");
  EXPECT_TRUE(cup.is_straight());
  EXPECT_EQ(cup, straight_cup(metres_from_mm(87), metres_from_mm(7), metres_from_mm(40), metres_from_mm(43)));
  for (const double height : {0.0, 0.007, 0.050, 0.087}) EXPECT_DOUBLE_EQ(cup.inner_radius(height), 0.040);
}

/// A bowl's bottom rises by less than 45°; a neck may be narrower than that.
TEST(CupProfile, IsNarrowestAtTheBottomsEdgeOrAtANeck) {
  const CupProfile bowl = read(R"({"inner_profile_mm": [[0, 5], [15, 7], [25, 13], [35, 30], [40, 60]],
                                   "outer_profile_mm": [[0, 0], [20, 0], [40, 30], [45, 60]]})");
  EXPECT_EQ(bowl.bottom_points(), 3u);
  EXPECT_DOUBLE_EQ(bowl.narrowest(), 0.025);
  const CupProfile jug = read(R"({"inner_profile_mm": [[0, 5], [40, 5], [40, 60], [22, 80], [28, 90]],
                                  "outer_profile_mm": [[0, 0], [44, 0], [44, 60], [26, 80], [32, 90]]})");
  EXPECT_DOUBLE_EQ(jug.narrowest(), 0.022);
  EXPECT_DOUBLE_EQ(jug.widest(), 0.044);
}

TEST(CupProfile, WhatCannotBeIsRefused) {
  expect_error([] { read(R"({"inner_profile_mm": [[0, 4], [26, 4], [38, 90]]})"); },
               {"cup.json: /outer_profile_mm: is missing"});
  expect_error(
      [] {
        read(R"({"inner_profile_mm": [[0, 4], [26, 4], [38, 90]],
                             "outer_profile_mm": [[0, 0], [27, 0], [39, 90]], "height_mm": 90})");
      },
      {"/height_mm: cannot stand beside a profile"});
  expect_error(
      [] {
        read(R"({"inner_profile_mm": [[0, 4], [26, 4], [38, 90]],
                             "outer_profile_mm": [[0, 0], [27, 0], [39, 80]]})");
      },
      {"/inner_profile_mm: must end at the outer rim's height"});
}

}  // namespace
}  // namespace fathom
