// What `fathom check` promises: rows that say what is there and what is missing, and an exit code that says whether a
// diagnosis can run.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/files.h"
#include "core/json.h"
#include "tests/app/run_fathom.h"
#include "tests/core/temporary_folder.h"

namespace fathom {
namespace {

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
  for (const char* part : {"frames                            3", "heights_without_cloud             3",
                           "distances                  300, 400 mm", "fills_of_water                   20 mm",
                           "3 of 3 frames have a height and no cloud.", "Nothing was measured twice.",
                           "  remedy: ", "A diagnosis can run; "})
    EXPECT_NE(run.out.find(part), std::string::npos) << part << " is not in\n" << run.out;
}

TEST_F(CheckCommand, SaysTheSameInJsonAndKeepsIt) {
  const ProgramRun run = check(kTable, "--json -o " + (folder / "out").string());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Json found = Json::parse(run.out);
  EXPECT_EQ(found, read_json(folder / "out" / "check.json"));
  EXPECT_EQ(found["can_run"], true);
  EXPECT_EQ(found["fills_mm"]["water"], Json::array({20.0}));
  const auto has = [&](const std::string& name) {
    return std::any_of(found["missing"].begin(), found["missing"].end(),
                       [&](const Json& lack) { return lack["name"] == name && lack["costs"] != ""; });
  };
  for (const char* name : {"clouds", "repeats", "pours", "fills", "laterals", "sessions", "stated_sigmas"})
    EXPECT_TRUE(has(name)) << name;
  for (const char* name : {"bare_desk_views", "empty_cup", "distances", "conditions"}) EXPECT_FALSE(has(name)) << name;
}

TEST_F(CheckCommand, WhereNoDiagnosisCanRunItFailsWithOneLine) {
  const auto expect_failed = [&](const std::string& rows, const std::string& what) {
    const ProgramRun run = check(rows);
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_EQ(run.err, "error: " + (folder / "frames.csv").string() + ": " + what + "\n");
    EXPECT_EQ(run.out, "");
  };
  expect_failed("cloud\n0,0,0,0,0,0,empty,0,300,0,a.pcd\n1,0,0,0,1,1,empty,0,300,0,b.pcd\n",
                "line 2, column 'cloud': there is no file " + (folder / "a.pcd").string() + ", and 1 more of 2 clouds");
  expect_failed("height_mm\n0,0,0,0,0,0,water,2000,300,0,9\n",
                "line 2, column 'fill_mm': must be from 0 to 86, the depth of the cup, got '2000'");
  expect_failed("height_mm\n0,0,0,0,0,0,water,20,300,0,\n",
                "line 2, column 'height_mm': is empty, and there is no cloud in its place");
}

/// A table of heights is read by all commands without a column for clouds.
TEST_F(CheckCommand, MeasureKeepsTheHeightsOfATableWithoutClouds) {
  write_text(folder / "frames.csv", kHeader + kTable);
  const ProgramRun run = run_fathom("measure " + (folder / "").string());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "note: frames.csv names no clouds: heights.csv has the heights that stand there already\n");
  EXPECT_NE(read_text(folder / "heights.csv").find("1,0,1,1,0,9,water,20,300,0,9.2,"), std::string::npos);
}

}  // namespace
}  // namespace fathom
