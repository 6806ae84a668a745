// Input that is allowed and yet hardly meant gets a line on stderr, and nothing else changes.
#include <gtest/gtest.h>

#include <string>

#include "core/files.h"
#include "tests/app/run_fathom.h"
#include "tests/core/temporary_folder.h"

namespace fathom {
namespace {

class Warnings : public ::testing::Test {
 protected:
  std::string written(const char* name, const std::string& text) {
    write_text(folder / name, text);
    return (folder / name).string();
  }

  ProgramRun shot(const std::string& scene) {
    return run_fathom("capture " + scene + " --mode geometric -o " + (folder / "out").string());
  }

  TemporaryFolder folder;
};

TEST_F(Warnings, LengthsThatMayBeMetresAreNamed) {
  const std::string scene = written("scene.json",
                                    R"({"sensor": {"model": "xtion_pro_live", "height_mm": 650, "aim_mm": [0, 300, 0]},
 "cups": [{"position_mm": [0, 300], "shape": "paper_cup", "liquid": "water", "fill_mm": 0.04}]})");
  const ProgramRun run = shot(scene);
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err,
            "warning: " + scene + ": /cups/0/fill_mm: 0.04 mm; lengths are in millimetres, were metres meant?\n");
}

TEST_F(Warnings, LengthsThatAreSmallButUsualAreNot) {
  const std::string scene = written("scene.json",
                                    R"({"sensor": {"model": "xtion_pro_live", "height_mm": 650, "aim_mm": [0, 300, 0]},
 "cups": [{"position_mm": [0, 300], "shape": "paper_cup", "liquid": "water", "fill_mm": 1}]})");
  EXPECT_EQ(shot(scene).err, "");
}

TEST_F(Warnings, ACupThatTheCameraDoesNotSeeIsNamed) {
  const std::string scene = written("scene.json",
                                    R"({"sensor": {"model": "xtion_pro_live", "height_mm": 650, "aim_mm": [0, 300, 0]},
 "cups": [{"position_mm": [0, 300], "shape": "paper_cup"}, {"position_mm": [460, 300], "shape": "paper_cup"},
          {"position_mm": [0, -200], "shape": "paper_cup"}]})");
  const ProgramRun run = shot(scene);
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err, "warning: " + scene +
                         ": /cups/1, /cups/2: are outside the camera's image; /sensor/aim_mm says where it looks\n");
}

TEST_F(Warnings, ACloudInMillimetresIsNamed) {
  std::string cloud =
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 400\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\n"
      "POINTS 400\nDATA ascii\n";
  for (int i = 0; i < 400; ++i) cloud += std::to_string(10 * (i % 20)) + " " + std::to_string(10 * (i / 20)) + " 650\n";
  const std::string file = written("mm.pcd", cloud);
  EXPECT_EQ(run_fathom("detect " + file).err,
            "warning: " + file +
                ": most points lie more than 50 m away; clouds are in metres, is this one in millimetres?\n");
  const ProgramRun calibrated = run_fathom("calibrate " + file + " -o " + (folder / "unit").string());
  EXPECT_EQ(calibrated.exit_code, 1);
  EXPECT_NE(calibrated.err.find("is this one in millimetres?"), std::string::npos) << calibrated.err;
}

TEST_F(Warnings, ACloudWithoutADeskIsNamed) {
  const std::string file = written(
      "two.pcd",
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\n"
      "POINTS 2\nDATA ascii\n0 0 1\n0 1 1\n");
  EXPECT_EQ(run_fathom("detect " + file).err, "warning: " + file + ": no desk: the cloud has 2 measured points\n");
}

}  // namespace
}  // namespace fathom
