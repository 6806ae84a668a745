// Things may touch and stand in each other's hollows, but not in each other's matter.
#include "sim/render/overlap.h"
#include "core/json.h"

#include <gtest/gtest.h>

#include "sim/scene/setup.h"

namespace fathom {
namespace {

/// "" or who stands in whom, of a scene with these cups and objects.
std::string overlap_of(const char* cups, const char* objects) {
  const Json scene = {{"sensor", {{"height_mm", 650}, {"pitch_deg", 60}}},
                      {"cups", Json::parse(cups)},
                      {"objects", Json::parse(objects)}};
  const Setup setup = setup_from_json(scene, "scene.json");
  const auto found = find_overlap(setup.scene, setup.rig.sensor.wavelength_nm);
  return found ? found->one + " in " + found->other : "";
}

std::string boxes(double apart_mm) {
  return overlap_of("[]",
                    Json::array({{{"solid", {{"box_mm", {40, 50, 60}}}}, {"position_mm", {0, 300}}},
                                 {{"solid", {{"box_mm", {40, 50, 30}}}}, {"position_mm", {40.0 + apart_mm, 310}}}})
                        .dump()
                        .c_str());
}

TEST(Overlap, ThingsMayTouch) {
  EXPECT_EQ(boxes(5.0), "");
  EXPECT_EQ(boxes(0.0), "");
  EXPECT_EQ(boxes(-0.1), "");  // half of what makes an overlap
  EXPECT_EQ(boxes(-0.5), "/objects/1 in /objects/0");
  EXPECT_EQ(boxes(-20.0), "/objects/1 in /objects/0");
}

TEST(Overlap, AHandleInAnotherCupIsFound) {
  // The mug's wall ends 39 mm from its axis and its handle 30 mm further out; the paper cup has a radius of 43 mm.
  const auto cups = [](double x_mm) {
    return Json::array(
               {{{"shape", "mug"}, {"position_mm", {0, 300}}}, {{"shape", "paper_cup"}, {"position_mm", {x_mm, 300}}}})
        .dump();
  };
  EXPECT_EQ(overlap_of(cups(120.0).c_str(), "[]"), "");
  EXPECT_EQ(overlap_of(cups(85.0).c_str(), "[]"), "/cups/1 in /cups/0");
  EXPECT_EQ(overlap_of(cups(-85.0).c_str(), "[]"), "");  // on the side without a handle
}

TEST(Overlap, WhatStandsInAHollowIsApartAndWhatStandsInMatterIsNot) {
  const char* cup = R"([{"shape": "paper_cup", "position_mm": [0, 300]}])";
  const auto box = [](const char* side_mm, const char* x_mm) {
    return std::string(R"([{"solid": {"box_mm": [)") + side_mm + ", " + side_mm + ", " + side_mm +
           R"(]}, "position_mm": [)" + x_mm + R"(, 300]}])";
  };
  EXPECT_EQ(overlap_of(cup, box("200", "0").c_str()), "/objects/0 in /cups/0");  // the cup within the box
  EXPECT_EQ(overlap_of(cup, box("200", "150").c_str()), "");
  const char* under = R"([{"solid": {"cup": "paper_cup"}, "rotation_deg": [180, 0, 0], "position_mm": [0, 300]},
                          {"solid": {"box_mm": [20, 20, 20]}, "position_mm": [0, 300]}])";
  EXPECT_EQ(overlap_of("[]", under), "");  // a cup turned over a cube
}

}  // namespace
}  // namespace fathom
