// What `fathom reproduce` promises: data that is the theory's, pictures, and one report.
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "core/files.h"
#include "core/json.h"
#include "core/table.h"
#include "core/units.h"
#include "report/whole_picture.h"
#include "tests/app/run_fathom.h"
#include "tests/core/file_size_limit.h"
#include "tests/core/temporary_folder.h"
#include "theory/raised_bottom.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

constexpr double kPrinted = 0.5001e-4;          // the tables have four decimals
constexpr double kAboveBottomMm = 650.0 - 7.0;  // the sensor stands 650 mm above the desk, the bottom 7 mm

struct ReproduceCommand : testing::Test {
  TemporaryFolder folder;
  ProgramRun reproduce(const std::string& arguments) {
    return run_fathom("reproduce " + arguments + " -o " + (folder / "out").string());
  }
};

TEST_F(ReproduceCommand, TheTheorysFiguresHoldTheTheorysNumbers) {
  ASSERT_EQ(reproduce("fig10 fig13").exit_code, 0);
  const Table fig10 = read_table(folder / "out" / "fig10.csv");
  ASSERT_EQ(fig10.rows(), 3u * 91u);
  for (std::size_t row = 0; row < fig10.rows(); row += 7)
    EXPECT_NEAR(fig10.number(row, "eq3_mm"),
                theory::raised_height(fig10.number(row, "fill_mm"),
                                      radians_from_deg(fig10.number(row, "incidence_deg")), 1.333),
                kPrinted);
  const Table fig13 = read_table(folder / "out" / "fig13.csv");
  for (std::size_t row = 0; row < fig13.rows(); row += 7)
    EXPECT_NEAR(fig13.number(row, "eq6_deg"),
                deg_from_radians(theory::incidence_angle_at(fig13.number(row, "distance_mm"), 75.0, kAboveBottomMm)),
                kPrinted);
}

TEST_F(ReproduceCommand, TheSkewAtTheFieldsEdgeIsThePrintedOne) {
  ASSERT_EQ(reproduce("fig12").exit_code, 0);
  const Table fig12 = read_table(folder / "out" / "fig12.csv");
  const std::size_t edge = fig12.rows() - 1;
  EXPECT_NEAR(fig12.number(edge, "field_deg"), 29.25, kPrinted);
  EXPECT_NEAR(fig12.number(edge, "skew_at_500_mm_range_deg"),
              deg_from_radians(theory::skew_at_field_edge(0.075, radians_from_deg(58.5), 0.5)), kPrinted);
  EXPECT_NEAR(fig12.number(edge, "skew_at_500_mm_range_deg"), 6.95, 0.005);  // the printed digits
}

TEST_F(ReproduceCommand, DrawsAndReportsWhatWasAsked) {
  const ProgramRun run = reproduce("fig12 --json");
  ASSERT_EQ(run.exit_code, 0);
  EXPECT_EQ(Json::parse(run.out).at(0)["figure"], "fig12");
  for (const char* file : {"fig12.csv", "fig12.gp", "fig12.svg"})
    EXPECT_TRUE(fs::exists(folder / "out" / file)) << file;
  EXPECT_EQ(read_text(folder / "out" / "fig12.png").substr(1, 3), "PNG");
  EXPECT_FALSE(fs::exists(folder / "out" / "fig10.csv"));
  const std::string report = read_text(folder / "out" / "report.html");
  EXPECT_NE(report.find("src=\"data:image/png;base64,iVBORw0KGgo"), std::string::npos);  // a PNG's first bytes
  EXPECT_EQ(report.find("src=\"fig"), std::string::npos);                                // nothing beside it is needed
}

TEST_F(ReproduceCommand, WithoutGnuplotItSaysWhatToInstall) {
  const char* path = std::getenv("PATH");
  const std::string before = path ? path : "";
  ::setenv("PATH", "/nowhere", 1);
  const ProgramRun run = reproduce("fig5");  // whose captures would take a minute
  ::setenv("PATH", before.c_str(), 1);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(run.err, "error: gnuplot: is not installed, and draws the figures; install gnuplot-nox\n");
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST_F(ReproduceCommand, OnlyWholePicturesAreLeftInTheFolder) {
  ASSERT_EQ(reproduce("fig13").exit_code, 0);
  std::set<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder / "out")) files.insert(entry.path().filename().string());
  EXPECT_EQ(files, (std::set<std::string>{"fig13.csv", "fig13.gp", "fig13.png", "fig13.svg", "report.html"}));
}

// Gnuplot itself says nothing of it.
TEST_F(ReproduceCommand, OnAFullDiskNoHalfPictureIsLeft) {
  ASSERT_EQ(reproduce("fig13").exit_code, 0);
  const std::uintmax_t png = fs::file_size(folder / "out" / "fig13.png"),
                       svg = fs::file_size(folder / "out" / "fig13.svg");
  for (const std::uintmax_t room : {png - 1, svg - 1, std::max(png, svg) - 1, std::min(png, svg) / 2}) {
    const FileSizeLimit limit(room);
    for (const char* file : {"fig13.png", "fig13.svg"}) fs::remove(folder / "out" / file);
    const ProgramRun run = reproduce("fig13");
    EXPECT_EQ(run.exit_code, 1) << room;
    EXPECT_EQ(run.err.rfind("error: " + (folder / "out/fig13.").string(), 0), 0u) << run.err;
    for (const char* file : {"fig13.png", "fig13.svg"})
      EXPECT_TRUE(!fs::exists(folder / "out" / file) || is_whole_picture(folder / "out" / file)) << room;
    EXPECT_FALSE(fs::exists(folder / "out" / "report.html"));
  }
}

TEST_F(ReproduceCommand, UnknownFiguresAreBadUsage) { EXPECT_EQ(reproduce("fig11").exit_code, 2); }

}  // namespace
}  // namespace fathom
