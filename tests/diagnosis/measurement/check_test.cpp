// What `fathom check` finds in a measurement directory, and what it does not miss.
#include "diagnosis/measurement/check.h"

#include <algorithm>

#include "core/image_file.h"
#include "tests/core/expect_error.h"
#include "tests/diagnosis/measurement/written_measurement.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

struct CheckedFolder : WrittenMeasurement {
  std::string rows;
  int frames = 0;

  /// One shot: "SESSION,POUR,PLACEMENT,TRIAL" and "LIQUID,FILL,DISTANCE,LATERAL", a second after the one before.
  void add(const std::string& repeat, const std::string& what, const std::string& cloud = "clouds/a.pcd") {
    rows += fmt::format("{},{},{},{},{}\n", frames, repeat, frames, what, cloud);
    ++frames;
  }
  MeasurementCheck check(const std::string& last_column = "cloud") {
    write_text(folder / "frames.csv", kFrameColumns + last_column + "\n" + rows);
    return check_measurement(folder / "");
  }
};

const Shortfall* find(const MeasurementCheck& check, Lack lack) {
  const auto found = std::find_if(check.lacks.begin(), check.lacks.end(),
                                  [&](const Shortfall& shortfall) { return shortfall.lack == lack; });
  return found == check.lacks.end() ? nullptr : &*found;
}

TEST_F(CheckedFolder, CountsWhatIsThere) {
  add("0,0,0,0", "none,0,0,0");
  add("0,0,0,0", "water,20,300,0");
  add("0,0,0,1", "water,20,300,0");
  add("0,0,1,0", "water,20,300,0");
  add("1,1,2,0", "water,30,300,0");
  add("1,2,3,0", "empty,0,300,0");
  const MeasurementCheck found = check();
  EXPECT_EQ(found.frames, 6u);
  EXPECT_EQ(found.clouds, 6u);
  EXPECT_EQ(found.heights, 0u);
  EXPECT_EQ(found.bare_desk_views, 1u);
  EXPECT_EQ(found.sessions, 2u);
  EXPECT_EQ(found.pours, 2u);  // an empty cup is none
  EXPECT_EQ(found.placements, 4u);
  EXPECT_EQ(found.fewest_trials, 1u);
  EXPECT_EQ(found.most_trials, 2u);
  EXPECT_EQ(found.fills_mm.at("water"), (std::set<double>{20.0, 30.0}));
  EXPECT_EQ(found.width, 640);
  EXPECT_EQ(found.height, 480);
}

/// Two sessions with bare-desk views, an empty cup, two fills poured twice, two places, two trials each, and a rig
/// whose errors are stated.
TEST_F(CheckedFolder, ACampaignThatHasAllLacksNothing) {
  write_text(folder / "rig.json",
             R"({"sensor": {"model": "xtion_pro_live", "height_mm": 650, "pitch_deg": 58.4, "sigma":
      {"height_mm": 1, "pitch_deg": 0.1, "roll_deg": 0.1, "baseline_mm": 0.1, "focal_px": 1, "disparity_offset_px": 0.1}},
      "cup": {"sigma": {"bottom_mm": 0.2}}, "liquids": {"water": "water"}, "fill_sigma_mm": 1, "placement_sigma_mm": 1,
      "session_mm": 0.2, "session_deg": 0.02})");
  int pour = 0, placement = 0;
  for (const std::string session : {"0", "1"}) {
    add(session + ",0,0,0", "none,0,0,0");
    for (const std::string filling : {"empty,0", "water,20", "water,40"}) {
      for (const std::string place : {",300,0", ",300,10", ",310,0"}) {
        for (const std::string trial : {"0", "1"})
          add(fmt::format("{},{},{},{}", session, pour, placement, trial), filling + place);
        ++placement;
      }
      ++pour;
    }
  }
  EXPECT_TRUE(check().lacks.empty());
}

TEST_F(CheckedFolder, SaysWhatACampaignOfOneShotEachLacks) {
  add("0,0,0,0", "water,20,300,0");
  add("0,1,1,0", "water,30,300,0");
  const MeasurementCheck found = check();
  ASSERT_TRUE(find(found, Lack::conditions));
  EXPECT_EQ(find(found, Lack::conditions)->size, 2.0);
  ASSERT_TRUE(find(found, Lack::bare_desk_views));
  // 0.1 px of disparity at a depth of 0.705 m make 1.16 mm of depth, 1.06 mm of it upwards.
  EXPECT_NEAR(find(found, Lack::bare_desk_views)->size, 1.06, 0.01);
  for (const Lack lack : {Lack::repeats, Lack::empty_cup, Lack::distances, Lack::laterals, Lack::sessions})
    EXPECT_TRUE(find(found, lack)) << static_cast<int>(lack);
  ASSERT_TRUE(find(found, Lack::pours));
  EXPECT_EQ(find(found, Lack::pours)->names, (std::vector<std::string>{"20 mm of water", "30 mm of water"}));
  ASSERT_TRUE(find(found, Lack::stated_sigmas));
  EXPECT_EQ(find(found, Lack::stated_sigmas)->names.size(), 9u);
  for (const Lack lack :
       {Lack::clouds, Lack::fills, Lack::times, Lack::brightness, Lack::desk_height, Lack::cup_in_image})
    EXPECT_FALSE(find(found, lack)) << static_cast<int>(lack);
  EXPECT_TRUE(std::is_sorted(found.lacks.begin(), found.lacks.end(),
                             [](const Shortfall& a, const Shortfall& b) { return a.lack < b.lack; }));
}

/// A share of a calibrated unit's bias is left to learn.
TEST_F(CheckedFolder, OfACalibratedUnitLessBiasIsLeft) {
  add("0,0,0,0", "water,20,300,0");
  write_exr(folder / "map.exr", {{"reference_px", Image<float>(640, 480)}, {"camera_px", Image<float>(640, 480)}});
  write_text(folder / "unit.json", R"({"bias": {"image": "map.exr", "reference_at_px": 30}})");
  write_text(folder / "rig.json", R"({"sensor": {"model": "xtion_pro_live", "height_mm": 650, "pitch_deg": 58.4,
      "unit": "unit.json"}, "cup": {}, "liquids": {"water": "water"}})");
  EXPECT_NEAR(find(check(), Lack::bare_desk_views)->size, 0.45 * 1.06, 0.01);
}

TEST_F(CheckedFolder, WhatSessionsMayDifferByIsAskedForWhereThereAreSeveral) {
  const auto names_of = [&](const std::string& more) {
    write_rig(more);
    const MeasurementCheck found = check();
    return find(found, Lack::stated_sigmas)->names;
  };
  const auto has = [](const std::vector<std::string>& names, const char* key) {
    return std::find(names.begin(), names.end(), key) != names.end();
  };
  add("0,0,0,0", "water,20,300,0");
  EXPECT_FALSE(has(names_of(""), "session_mm"));
  add("1,0,0,0", "water,20,300,0");
  EXPECT_TRUE(has(names_of(""), "session_mm"));
  EXPECT_FALSE(has(names_of(R"(, "session_mm": 0.3)"), "session_mm"));
  EXPECT_TRUE(has(names_of(R"(, "session_mm": 0.3)"), "session_deg"));
}

/// A table has no desk to learn a unit from, so that bare-desk views are no remedy.
TEST_F(CheckedFolder, OfATableOfHeightsCloudsAreWhatIsMissing) {
  add("0,0,0,0", "empty,0,300,0", "7");
  add("0,0,0,1", "empty,0,300,0", "7.1");
  add("0,1,1,0", "water,20,300,0", "12");
  const MeasurementCheck found = check("height_mm");
  EXPECT_EQ(found.heights, 3u);
  ASSERT_TRUE(find(found, Lack::clouds));
  EXPECT_EQ(find(found, Lack::clouds)->size, 3.0);
  EXPECT_FALSE(find(found, Lack::bare_desk_views));
  ASSERT_TRUE(find(found, Lack::fills));
  EXPECT_EQ(find(found, Lack::fills)->names, std::vector<std::string>{"water"});
}

TEST_F(CheckedFolder, ASensorThatStandsElsewhereIsSeenInTheClouds) {
  write_rig("", 660.0);
  add("0,0,0,0", "water,20,300,0");
  const MeasurementCheck found = check();
  ASSERT_TRUE(find(found, Lack::desk_height));
  EXPECT_NEAR(find(found, Lack::desk_height)->size, -10.0, 0.1);
  EXPECT_FALSE(find(found, Lack::desk_pitch));
}

TEST_F(CheckedFolder, ACupThatReachesOutOfTheImageIsNamed) {
  add("0,0,0,0", "water,20,300,0", "12");
  add("0,0,1,0", "water,20,300,340", "12");
  const MeasurementCheck found = check("height_mm");
  ASSERT_TRUE(find(found, Lack::cup_in_image));
  EXPECT_EQ(find(found, Lack::cup_in_image)->names, std::vector<std::string>{"distance 300 mm, lateral 340 mm"});
}

/// The near wall hides the bottom from 400 mm on, not what stands high in the cup.
TEST_F(CheckedFolder, ACupThatHidesItsInsideIsNamed) {
  write_text(folder / "rig.json", fmt::format(R"({{"sensor": {{"model": "xtion_pro_live", "height_mm": 650,
      "pitch_deg": {}}}, "cup": {{"shape": "mug"}}, "liquids": {{"water": "water"}}}})",
                                              kPitchDeg));
  add("0,0,0,0", "empty,0,300,0");
  add("0,0,1,0", "empty,0,450,0");
  add("0,1,2,0", "water,80,450,0");
  add("0,1,3,0", "water,60,300,0");
  MeasurementCheck found = check();
  ASSERT_TRUE(find(found, Lack::inside_in_sight));
  EXPECT_EQ(find(found, Lack::inside_in_sight)->names,
            std::vector<std::string>{"empty at distance 450 mm, lateral 0 mm"});
  // So it is where only heights were written down.
  rows.clear();
  add("0,0,0,0", "empty,0,300,0", "8");
  add("0,0,1,0", "empty,0,500,0", "8");
  found = check("height_mm");
  ASSERT_TRUE(find(found, Lack::inside_in_sight));
  EXPECT_EQ(find(found, Lack::inside_in_sight)->names,
            std::vector<std::string>{"empty at distance 500 mm, lateral 0 mm"});
}

TEST_F(CheckedFolder, ACopyThatBrokeOffIsNamed) {
  for (const char* name : {"clouds/b.pcd", "clouds/c.pcd"}) fs::copy_file(folder / "clouds/a.pcd", folder / name);
  write_text(folder / "clouds/d.pcd", read_text(folder / "clouds/a.pcd").substr(0, 1000000));
  for (int i = 0; i < 20; ++i)
    add(fmt::format("0,0,0,{}", i), "water,20,300,0",
        i == 1  ? "clouds/d.pcd"
        : i % 2 ? "clouds/b.pcd"
                : "clouds/c.pcd");
  const MeasurementCheck found = check();  // of eight clouds that are read it is none
  ASSERT_TRUE(find(found, Lack::whole_clouds));
  EXPECT_EQ(find(found, Lack::whole_clouds)->names, std::vector<std::string>{"1"});
}

TEST_F(CheckedFolder, WhatStopsADiagnosisIsOneLineThatCountsTheRest) {
  const auto expect_refused = [&](const std::string& what, const std::string& last_column = "cloud") {
    expect_error([&] { check(last_column); }, {(folder / "frames.csv").string() + ": " + what});
    rows.clear(), frames = 0;
  };
  add("0,0,0,0", "water,20,300,0");
  add("0,0,0,1", "water,20,300,0", "clouds/b.pcd");
  add("0,0,0,2", "water,20,300,0", "clouds/c.pcd");
  expect_refused("line 3, column 'cloud': there is no file " + (folder / "clouds/b.pcd").string() +
                 ", and 1 more of 3 files");
  write_text(folder / "clouds/nothing.pcd", "");
  add("0,0,0,0", "water,20,300,0", "clouds/nothing.pcd");
  expect_refused("line 2, column 'cloud': there is nothing in " + (folder / "clouds/nothing.pcd").string());
  add("0,0,0,0", "water,20,300,0", "clouds/a.pcd,none.png");
  add("0,0,0,1", "water,20,300,0", "clouds/a.pcd,none.png");
  expect_refused("line 2, column 'ir': there is no file " + (folder / "none.png").string() + ", and 1 more of 2 files",
                 "cloud,ir");
  write_text(folder / "none.png", "no image");
  add("0,0,0,0", "water,20,300,0", "clouds/a.pcd,none.png");
  expect_refused("line 2, column 'ir': " + (folder / "none.png").string() + ": ", "cloud,ir");
  add("0,0,0,0", "water,20,0.3,0");
  expect_refused("line 2, column 'distance_mm': must be in mm");
  add("0,0,0,0", "water,20,300,150");
  expect_refused("line 2, column 'distance_mm': 1 of 1 clouds that were looked at show the bare desk");
  write_pcd(folder / "clouds/mm.pcd", ideal_cloud(kHeight, 0.020, 0.0, 1000.0f));
  add("0,0,0,0", "water,20,300,0", "clouds/mm.pcd");
  expect_refused("line 2, column 'cloud': " + (folder / "clouds/mm.pcd").string() + ": must be in metres");
  write_pcd(folder / "clouds/lower.pcd", ideal_cloud(1.3 * kHeight, 0.020));
  add("0,0,0,0", "water,20,300,0", "clouds/lower.pcd");
  expect_refused("line 2, column 'cloud': 1 of 1 clouds that were looked at show no desk where rig.json says it is");
}

}  // namespace
}  // namespace fathom
