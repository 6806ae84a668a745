// What `fathom check` promises: rows that say what is there and what is missing, and an exit code that says whether a
// diagnosis can run.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/files.h"
#include "core/image_file.h"
#include "core/json.h"
#include "tests/app/run_fathom.h"
#include "tests/core/temporary_folder.h"

namespace fathom {
namespace check_test {

constexpr const char* kHeader = "frame,session,pour,placement,trial,time_s,liquid,fill_mm,distance_mm,lateral_mm,";

struct CheckCommand : testing::Test {
  TemporaryFolder folder;

  void SetUp() override {
    write_text(folder / "rig.json", R"({"sensor": {"model": "xtion_pro_live", "height_mm": 650, "pitch_deg": 58.4},
                                        "cup": {"shape": "tapered_cup"}, "liquids": {"water": "water"}})");
  }
  ProgramRun check(const std::string& rows, const std::string& options = "") {
    write_text(folder / "frames.csv", kHeader + rows);
    return run_fathom("check " + (folder / "").string() + " " + options);
  }
};

const std::string kTable =
    "height_mm\n0,0,0,0,0,0,empty,0,300,0,4.1\n1,0,1,1,0,9,water,20,300,0,9.2\n2,0,1,2,0,18,water,20,400,0,9.4\n";

TEST_F(CheckCommand, SaysInRowsWhatIsThereAndWhatIsMissing) {
  const ProgramRun run = check(kTable);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const char* part :
       {"frames                            3", "heights_without_cloud             3",
        "distances                  300, 400 mm", "fills_of_water                   20 mm",
        "3 of 3 frames have a height and no cloud.", "Hardly anything was measured twice.",
        "  remedy: ", "A diagnosis can run, but its verdict will be insufficient. Hardly anything was measured twice."})
    EXPECT_NE(run.out.find(part), std::string::npos) << part << " is not in\n" << run.out;
}

TEST_F(CheckCommand, SaysTheSameInJsonAndKeepsIt) {
  const ProgramRun run = check(kTable, "--json -o " + (folder / "out").string());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Json found = Json::parse(run.out);
  EXPECT_EQ(found, read_json(folder / "out" / "check.json"));
  EXPECT_EQ(found["can_run"], true);
  EXPECT_EQ(found["can_answer"], false);
  EXPECT_EQ(found["fills_mm"]["water"], Json::array({20.0}));
  const auto has = [&](const std::string& name) {
    return std::any_of(found["missing"].begin(), found["missing"].end(),
                       [&](const Json& lack) { return lack["name"] == name && lack["costs"] != ""; });
  };
  for (const char* name : {"clouds", "repeats", "pours", "fills", "laterals", "sessions", "stated_sigmas"})
    EXPECT_TRUE(has(name)) << name;
  for (const char* name : {"bare_desk_views", "empty_cup", "distances", "conditions"}) EXPECT_FALSE(has(name)) << name;
}

TEST_F(CheckCommand, AnExampleCanBeCheckedAndIsNeverWrittenOverAnother) {
  const std::string lab = (folder / "lab").string();
  EXPECT_EQ(run_fathom("check --example -o " + lab).exit_code, 0);
  EXPECT_EQ(run_fathom("check " + lab).exit_code, 0);
  const ProgramRun again = run_fathom("check --example -o " + lab);
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_EQ(again.err, "error: " + lab + "/rig.json: is there already; choose another folder\n");
  const ProgramRun nothing = run_fathom("check");
  EXPECT_EQ(nothing.exit_code, 2);
  EXPECT_NE(nothing.err.find("DIR is required, or --example"), std::string::npos) << nothing.err;
}

TEST_F(CheckCommand, WhereNoDiagnosisCanRunItFailsWithOneLine) {
  const auto expect_failed = [&](const std::string& rows, const std::string& what) {
    const ProgramRun run = check(rows);
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_EQ(run.err, "error: " + (folder / "frames.csv").string() + ": " + what + "\n");
    EXPECT_EQ(run.out, "");
  };
  expect_failed("cloud\n0,0,0,0,0,0,empty,0,300,0,a.pcd\n1,0,0,0,1,1,empty,0,300,0,b.pcd\n",
                "line 2, column 'cloud': there is no file " + (folder / "a.pcd").string() + ", and 1 more of 2 files");
  expect_failed("height_mm\n0,0,0,0,0,0,water,2000,300,0,9\n",
                "line 2, column 'fill_mm': must be from 0 to 86, the depth of the cup, got '2000'");
  expect_failed("height_mm\n0,0,0,0,0,0,water,20,300,0,\n",
                "line 2, column 'height_mm': is empty, and there is no cloud in its place");
}

/// What only the model of the measurement refuses.
TEST_F(CheckCommand, AModelThatDoesNotExistStopsItAsItStopsADiagnosis) {
  const auto error_of = [&](const std::string& sensor, const std::string& cup, const std::string& liquids) {
    write_text(folder / "rig.json", R"({"sensor": {"height_mm": 650, "pitch_deg": 58.4, )" + sensor + R"(}, "cup": {)" +
                                        cup + R"(}, "liquids": {)" + liquids + "}}");
    const ProgramRun run = check(kTable);
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_EQ(run.out, "");
    const std::string file = "error: " + (folder / "rig.json").string() + ": ";
    EXPECT_EQ(run.err.substr(0, file.size()), file);
    return run.err.substr(std::min(run.err.size(), file.size()));
  };
  const std::string model = R"("model": "xtion_pro_live")", water = R"("water": "water")";
  const auto expect_start = [](const std::string& text, const std::string& start) {
    EXPECT_EQ(text.substr(0, start.size()), start);
  };
  expect_start(error_of(R"("model": "xtionn")", "", water), "/sensor/model: ");
  expect_start(error_of(model, "", R"("water": "watr")"), "/liquids/water: ");
  expect_start(error_of(model, R"("bottom_mm": 0)", water), "/cup/bottom_mm: ");
  expect_start(error_of(model, R"("inner_radius_mm": 43)", water), "/cup/outer_radius_mm: ");
}

TEST_F(CheckCommand, SaysWhatIsTakenOfSessionsAndWhereTheUnitComesFrom) {
  const std::string two_sessions = kTable + "3,1,0,0,0,0,water,20,400,0,9.4\n";
  ProgramRun run = check(two_sessions);
  EXPECT_NE(run.out.find("0.1 mm, the default; 0.0115°, the default"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("session_mm 0.1, session_deg 0.0115"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("not known: there are no clouds"), std::string::npos) << run.out;
  write_exr(folder / "map.exr", {{"reference_px", Image<float>(640, 480)}, {"camera_px", Image<float>(640, 480)}});
  write_text(folder / "unit.json", R"({"bias": {"image": "map.exr", "reference_at_px": 30}})");
  write_text(folder / "rig.json", R"({"sensor": {"model": "xtion_pro_live", "height_mm": 650, "pitch_deg": 58.4,
      "unit": "unit.json"}, "cup": {"shape": "tapered_cup"}, "liquids": {"water": "water"}, "session_mm": 0.3})");
  run = check(two_sessions, "--json");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Json found = Json::parse(run.out);
  EXPECT_EQ(found["session_mm"], Json({{"value", 0.3}, {"stated", true}}));
  EXPECT_EQ(found["session_deg"]["stated"], false);
  EXPECT_EQ(found["unit"], Json({{"from", "calibration"}, {"file", (folder / "unit.json").string()}}));
  EXPECT_EQ(check(kTable).out.find("session_mm"), std::string::npos) << "of one session there is nothing to take";
}

/// A table of heights is read by all commands without a column for clouds.
TEST_F(CheckCommand, MeasureKeepsTheHeightsOfATableWithoutClouds) {
  write_text(folder / "frames.csv", kHeader + kTable);
  const ProgramRun run = run_fathom("measure " + (folder / "").string());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "note: frames.csv names no clouds: heights.csv has the heights that stand there already\n");
  EXPECT_NE(read_text(folder / "heights.csv").find("1,0,1,1,0,9,water,20,300,0,9.2,"), std::string::npos);
}

}  // namespace check_test
}  // namespace fathom
