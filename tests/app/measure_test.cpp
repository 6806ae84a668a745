// What `fathom measure` promises: the measurement directory in, heights.csv out.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "core/files.h"
#include "core/table.h"
#include "tests/app/run_fathom.h"
#include "tests/detector/synthetic.h"

namespace fathom {
namespace measure_test {

namespace fs = std::filesystem;

constexpr const char* kHeader = "frame,session,pour,placement,trial,time_s,liquid,fill_mm,distance_mm,lateral_mm,cloud";

struct MeasureCommand : testing::Test {
  fs::path folder = fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();

  void SetUp() override {
    make_directory(folder / "clouds");
    synthetic::write_cup(folder / "clouds/empty.pcd", 0.007);
    synthetic::write_cup(folder / "clouds/filled.pcd", 0.0173);
    // The cup of these clouds stands straight ahead of the camera, half a baseline left of the rig's middle.
    write_text(folder / "rig.json", R"({"sensor": {"model": "xtion_pro_live", "height_mm": 650, "pitch_deg": 58.39},
                                        "cup": {"shape": "paper_cup"}, "liquids": {"water": "water"}})");
  }
  void TearDown() override { fs::remove_all(folder); }

  ProgramRun measure(const std::string& rows, const std::string& header = kHeader) {
    write_text(folder / "frames.csv", header + "\n" + rows);
    return run_fathom("measure " + folder.string());
  }
  std::string error_of(const std::string& rows, const std::string& header = kHeader) {
    const ProgramRun run = measure(rows, header);
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_FALSE(fs::exists(folder / "heights.csv"));
    const std::string file = "error: " + (folder / "frames.csv").string() + ": ";
    return run.err.starts_with(file) ? run.err.substr(file.size()) : run.err;
  }
};

TEST_F(MeasureCommand, FillsTheHeightsOfEveryFrameWithACup) {
  const ProgramRun run = measure(
      "0,0,0,0,0,0,empty,0,400,-37.5,clouds/empty.pcd\n"
      "1,0,1,1,0,5,water,20,400,-37.5,clouds/filled.pcd\n"
      "2,0,0,0,0,9,none,0,0,0,clouds/empty.pcd\n"
      "3,0,1,1,0,9,water,20,300,-37.5,clouds/filled.pcd\n");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Table table = read_table(folder / "heights.csv");
  ASSERT_EQ(table.rows(), 4u);
  EXPECT_NEAR(table.number(0, "height_mm"), 7.0, 0.1);  // the bottom pulls the desk's plane a little
  EXPECT_NEAR(table.number(1, "height_mm"), 17.3, 0.1);
  EXPECT_GT(table.number(1, "points"), 50.0);
  EXPECT_LT(table.number(1, "height_sd_mm"), 0.1);
  EXPECT_EQ(table.text(2, "height_mm"), "") << "no cup on a bare desk";
  EXPECT_EQ(table.text(3, "height_mm"), "") << "no cup within its own radius of where it should stand";
  EXPECT_EQ(table.text(3, "cloud"), "clouds/filled.pcd");
  EXPECT_EQ(run.err, "warning: 1 frames have no height because no cup is seen where it should stand: 3\n");
}

// A desk of which few points are left stays the desk, though a bottom 7 mm above it has more of them.
TEST_F(MeasureCommand, CloudsThinnedOnTheDeskHaveTheHeightsOfWholeOnes) {
  synthetic::write_thinned_cup(folder / "clouds/empty.pcd", 0.007);
  synthetic::write_thinned_cup(folder / "clouds/filled.pcd", 0.0097);
  const ProgramRun run = measure(
      "0,0,0,0,0,0,empty,0,400,-37.5,clouds/empty.pcd\n"
      "1,0,1,1,0,5,water,10,400,-37.5,clouds/filled.pcd\n");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Table table = read_table(folder / "heights.csv");
  EXPECT_NEAR(table.number(0, "height_mm"), 7.0, 0.1);
  EXPECT_NEAR(table.number(1, "height_mm"), 9.7, 0.1);
}

TEST_F(MeasureCommand, AFolderForTheResultsKeepsTheMeasurementsAsTheyAre) {
  write_text(folder / "frames.csv", std::string(kHeader) + "\n0,0,0,0,0,0,empty,0,400,-37.5,clouds/empty.pcd\n");
  ASSERT_EQ(run_fathom("measure " + folder.string() + " -o " + (folder / "out").string()).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder / "out" / "heights.csv"));
  EXPECT_FALSE(fs::exists(folder / "heights.csv"));
}

TEST_F(MeasureCommand, AHeightWithoutACloudStaysAsItIs) {
  const ProgramRun run =
      measure("0,0,0,0,0,0,empty,0,400,0,,7.2,0.5,300\n", kHeader + std::string(",height_mm,height_sd_mm,points"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(read_table(folder / "heights.csv").text(0, "height_mm"), "7.2");
}

TEST_F(MeasureCommand, MistakesNameTheLineAndTheColumn) {
  EXPECT_EQ(error_of("0,0,0,0,0,0,wine,0,400,0,clouds/empty.pcd\n"),
            "line 2, column 'liquid': unknown liquid 'wine', choose from empty, none, water\n");
  EXPECT_EQ(error_of("0,0,0,0,0,0,water,deep,400,0,clouds/empty.pcd\n"),
            "line 2, column 'fill_mm': must be a finite number, got 'deep'\n");
  EXPECT_EQ(error_of("0,0,0,0,0,0,empty,0,400,0,clouds/empty.pcd\n1,0,0,0,0,0,empty,0,400,0,clouds/no.pcd\n"),
            "line 3, column 'cloud': there is no file " + (folder / "clouds/no.pcd").string() + "\n");
  EXPECT_EQ(error_of("0,0,0,0,0,0,empty,0,400,0,\n"),
            "line 2, column 'cloud': is empty, and there is no height_mm in its place\n");
  EXPECT_EQ(error_of("0,0\n", "frame,liquid"), "line 1: has no column 'session', only frame,liquid\n");
  write_text(folder / "clouds/bad.pcd", "hello\n");
  EXPECT_EQ(error_of("0,0,0,0,0,0,empty,0,400,0,clouds/bad.pcd\n"),
            "line 2, column 'cloud': " + (folder / "clouds/bad.pcd").string() + ": is neither PCD nor PLY\n");
  write_text(folder / "clouds/mm.pcd",
             "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ascii\n"
             "-50 20 705\n50 20 705\n");
  EXPECT_EQ(error_of("0,0,0,0,0,0,empty,0,400,0,clouds/mm.pcd\n"),
            "line 2, column 'cloud': " + (folder / "clouds/mm.pcd").string() +
                ": must be in metres: most of its points lie more than 50 away\n");
}

TEST_F(MeasureCommand, WithoutAnyHeightItFailsAndKeepsWhatItHad) {
  write_text(folder / "heights.csv", "mine");
  const ProgramRun run = measure("0,0,0,0,0,0,empty,0,250,-37.5,clouds/empty.pcd\n");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("none of its clouds has a height in the cup"), std::string::npos) << run.err;
  EXPECT_EQ(read_text(folder / "heights.csv"), "mine");
}

}  // namespace measure_test
}  // namespace fathom
