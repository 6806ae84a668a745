// What `fathom evaluate` promises: rates over labelled clouds, and every failure by name.
#include <gtest/gtest.h>

#include <filesystem>

#include "core/files.h"
#include "core/json.h"
#include "core/table.h"
#include "tests/app/run_fathom.h"
#include "tests/detector/synthetic.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

/// Two scenes with a cup 400 mm away, one of them turned into a closed one.
struct EvaluateCommand : testing::Test {
  fs::path folder = fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();

  void SetUp() override {
    make_directory(folder);
    synthetic::write_cup(folder / "open.pcd", 0.007);
    synthetic::write_cup(folder / "closed.pcd", 0.085);
  }
  void TearDown() override { fs::remove_all(folder); }
  ProgramRun evaluate(const std::string& rows) {
    write_text(folder / "cups_groundtruth.csv", "scene,labels,object,support,horiz_dist_m,circle_r_mm\n" + rows);
    return run_fathom("evaluate " + folder.string() + " --json -o " + (folder / "out").string());
  }
};

TEST_F(EvaluateCommand, CountsCupsAndWhatMustNotBeTakenForOne) {
  const ProgramRun run = evaluate("open,1,mug_upright,table,0.400,41.5\nclosed,1,mug_inverted,table,0.400,\n");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Json json = Json::parse(run.out);
  EXPECT_EQ(json.at("cups_found").at("value"), "1/1");
  EXPECT_EQ(json.at("others_refused").at("value"), "1/1");
  EXPECT_NEAR(json.at("cups_found_low").at("value").get<double>(), 0.2065, 1e-4);  // 1 / (1 + 1.96²)
  EXPECT_EQ(json.at("unlabelled_cups").at("value"), 0.0);
  EXPECT_FALSE(json.contains("failure0"));
  const Table table = read_table(folder / "out" / "containers.csv");
  ASSERT_EQ(table.rows(), 2u);
  EXPECT_EQ(table.text(0, "found"), "yes");
  EXPECT_NEAR(table.number(0, "floor_mm"), 7.0, 0.2);  // the bottom pulls the desk's plane a little
}

TEST_F(EvaluateCommand, EveryFailureHasItsName) {
  const ProgramRun run = evaluate("open,1,mug_upright,table,0.600,41.5\nclosed,2,cup_upright,table,0.400,\n");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Json json = Json::parse(run.out);
  EXPECT_EQ(json.at("cups_found").at("value"), "0/2");
  EXPECT_EQ(json.at("failure0").at("value"), "open 1 mug_upright: not found");
  EXPECT_EQ(json.at("failure1").at("value").get<std::string>().rfind("closed 2 cup_upright: not found: closed", 0), 0u);
  EXPECT_EQ(json.at("unlabelled_cups").at("value"), 1.0);
}

TEST_F(EvaluateCommand, WhatIsMissingIsOneLine) {
  const ProgramRun run = evaluate("other,1,mug_upright,table,0.400,\n");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(run.err, "error: " + (folder / "cups_groundtruth.csv").string() +
                         ": line 2, column 'scene': there is no cloud other.pcd or other.ply\n");
}

}  // namespace
}  // namespace fathom
