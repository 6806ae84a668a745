// What the page of a diagnosis is given: of each condition the heights, measured and as the model has them, and the
// points of one of its shots.
#include <gtest/gtest.h>

#include "core/files.h"
#include "report/cup_shots_json.h"
#include "tests/core/expect_error.h"
#include "tests/core/temporary_folder.h"
#include "tests/view/unpacked.h"
#include "view/scenes.h"

namespace fathom {
namespace {

constexpr const char* kColumns =
    "observable,region,session,pour,placement,liquid,fill_mm,distance_mm,lateral_mm,measured,before,after,sigma,"
    "pixels\n";

struct DiagnosisPage : testing::Test {
  TemporaryFolder folder;
  Json report = {{"verdict", "named"}, {"answer", "Every pour is larger."}, {"effects", {{{"name", "fill_scale"}}}}};
  Json shots = Json::parse(R"({
      "cup": {"inner_profile_mm": [[0, 7], [40, 7], [40, 87]], "outer_profile_mm": [[0, 0], [43, 0], [43, 87]]},
      "heights_within_mm": 30,
      "shots": [{"frame": "12", "session": 0, "pour": 1, "placement": 3, "liquid": "paint", "fill_mm": 30,
                 "distance_mm": 300, "lateral_mm": -80, "camera_mm": [100, -300, 650],
                 "points_mm": [0, 1.5, 42, 10, -3, 41.5]}]})");
  std::string rows =
      "height_mm,centre,0,0,2,paint,30,300,-80,41,4,0.5,0.3,400\n"
      "height_mm,centre,0,1,3,paint,30,300,-80,42,5,0.1,0.3,400\n"
      "height_mm,far,0,1,3,paint,30,300,-80,42.5,6,-0.2,0.3,400\n"
      "cup_x_mm,walls,0,1,3,paint,30,300,-80,0.2,0.2,0.1,0.3,400\n"
      "height_mm,centre,0,2,4,empty,0,300,-80,7.1,0.1,0,0.3,400\n";

  Json scene() {
    write_json(folder / "report.json", report);
    write_text(folder / "residuals.csv", kColumns + rows);
    write_json(folder / kShotsFile, shots);
    return diagnosis_scene(folder / "");
  }
  void expect_refused(std::initializer_list<std::string> parts) {
    expect_error([&] { scene(); }, parts);
  }
};

TEST_F(DiagnosisPage, HasEachConditionWithTheHeightsOfTheShotThatItShows) {
  const Json page = scene();
  EXPECT_EQ(page["answer"], "Every pour is larger.");
  EXPECT_EQ(page["effects"], Json{"fill scale"});
  ASSERT_EQ(page["conditions"].size(), 2u);
  const Json &empty = page["conditions"][0], &paint = page["conditions"][1];
  EXPECT_EQ(empty["liquid"], "empty");
  EXPECT_FALSE(empty.contains("shot"));
  EXPECT_NEAR(paint["before_mm"].get<double>(), 5.0, 1e-9);  // of all three heights
  EXPECT_EQ(paint["placements"], 2);
  ASSERT_EQ(paint["regions"].size(), 2u);  // of the placement that was shot
  EXPECT_EQ(paint["regions"][1]["region"], "far");
  EXPECT_NEAR(paint["regions"][1]["before_mm"].get<double>(), 36.5, 1e-9);
  EXPECT_NEAR(paint["regions"][1]["after_mm"].get<double>(), 42.7, 1e-9);
  const auto places = unpacked<std::int16_t>(paint["shot"]["points"]);
  ASSERT_EQ(places.size(), 6u);
  EXPECT_NEAR(places[5] * page["step_m"].get<double>(), 0.0415, 1e-5);
  EXPECT_EQ(paint["shot"]["frame"], "12");
}

TEST_F(DiagnosisPage, ShowsHeightsWithoutTheShotOfAnotherPlacement) {
  shots["shots"][0]["placement"] = 7;
  const Json paint = scene()["conditions"][1];
  EXPECT_FALSE(paint.contains("shot"));
  EXPECT_EQ(paint["regions"].size(), 1u);
}

TEST_F(DiagnosisPage, RefusesWhatIsDamaged) {
  rows += "height_mm,<b>,0,2,4,empty,0,300,-80,7.1,0.1,0,0.3,400\n";
  expect_refused({"residuals.csv: line 7, column 'region'"});
  rows = "cup_x_mm,walls,0,1,3,paint,30,300,-80,0.2,0.2,0.1,0.3,400\n";
  expect_refused({"residuals.csv", "no heights"});
  rows = "height_mm,centre,0,2,4,empty,0,300,-80,high,0.1,0,0.3,400\n";
  expect_refused({"residuals.csv: line 2, column 'measured'"});
  rows = "height_mm,centre,0,2,4,empty,0,300,-80,7.1,0.1,0,0.3,400\n";
  shots["shots"][0]["points_mm"] = {1, 2};
  expect_refused({"shots.json: /shots/0/points_mm: must be three numbers for each point"});
  shots["cup"]["inner_profile_mm"] = {{0, -7}};
  expect_refused({"shots.json: /cup/inner_profile_mm"});
  report["verdict"] = "insufficient";
  expect_refused({"report.json: /verdict: is insufficient"});
}

TEST_F(DiagnosisPage, SaysWhichFileIsMissing) {
  scene();
  std::filesystem::remove(folder / kShotsFile);
  expect_error([&] { diagnosis_scene(folder / ""); }, {"shots.json"});
}

}  // namespace
}  // namespace fathom
