// `fathom view` and `fathom export` as users run them: one file, or one line that says why there is none.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/files.h"
#include "core/image_file.h"
#include "core/json.h"
#include "tests/app/run_fathom.h"
#include "tests/core/temporary_folder.h"

namespace fathom {
namespace {

class ViewCommand : public testing::Test {
 protected:
  ViewCommand() {
    write_json(folder_ / "scene.json", Json::parse(R"({
      "sensor": {"model": "xtion_pro_live", "height_mm": 650, "aim_mm": [0, 300, 0], "ir_size_px": [640, 512],
                 "depth_size_px": [320, 240], "focal_px": 285},
      "cups": [{"shape": "paper_cup", "position_mm": [0, 300], "liquid": "water", "fill_mm": 30}]})"));
    const ProgramRun shot = run("capture {0}/scene.json --mode geometric -o {0}/shot --quiet");
    EXPECT_EQ(shot.exit_code, 0) << shot.err;
  }

  /// {0} stands for the test's folder.
  ProgramRun run(const std::string& arguments) const {
    return run_fathom(fmt::format(fmt::runtime(arguments), (folder_ / "").parent_path().string()));
  }

  void expect_no_page(const std::string& what) const {
    const ProgramRun view = run("view {0}/shot");
    EXPECT_EQ(view.exit_code, 1);
    EXPECT_NE(view.err.find(what), std::string::npos) << view.err;
    EXPECT_EQ(std::count(view.err.begin(), view.err.end(), '\n'), 1) << view.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "shot/view.html"));
  }

  Image<float> depth() const { return read_exr_channel(folder_ / "shot/depth.exr", "Z"); }

  TemporaryFolder folder_;
};

TEST_F(ViewCommand, WritesOnePageBesideTheCaptureOrWhereItIsTold) {
  EXPECT_EQ(run("view {0}/shot").exit_code, 0);
  EXPECT_EQ(run("view {0}/shot -o {0}/page.html").exit_code, 0);
  const std::string page = read_text(folder_ / "page.html");
  EXPECT_EQ(page, read_text(folder_ / "shot/view.html"));
  EXPECT_LT(page.size(), 5'000'000U);
  // The next capture is not the one that the page shows.
  EXPECT_EQ(run("capture {0}/scene.json --mode geometric -o {0}/shot --quiet --seed 2").exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "shot/view.html"));
}

TEST_F(ViewCommand, RefusesAFolderThatIsNoCaptureOrWasNotFinished) {
  std::filesystem::remove(folder_ / "shot/run.json");
  expect_no_page("holds no complete capture");
  EXPECT_EQ(run("view {0}/nowhere").exit_code, 1);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "nowhere"));
}

TEST_F(ViewCommand, RefusesDepthsThatAreNoDepths) {
  for (const float wrong : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -0.5f}) {
    Image<float> damaged = depth();
    damaged(17, 3) = wrong;
    write_exr(folder_ / "shot/depth.exr", {{"Z", damaged}});
    expect_no_page("depth.exr: pixel (17, 3): must be a depth in metres, or 0");
  }
}

TEST_F(ViewCommand, RefusesDamagedFiles) {
  const std::string whole = read_text(folder_ / "shot/depth.exr");
  write_text(folder_ / "shot/depth.exr", whole.substr(0, whole.size() / 2));
  expect_no_page("depth.exr");
  write_exr(folder_ / "shot/depth.exr", {{"Z", Image<float>(20, 10, 0.5f)}});
  expect_no_page("depth.exr");
  write_text(folder_ / "shot/depth.exr", whole);
  write_text(folder_ / "shot/run.json", read_text(folder_ / "shot/run.json").substr(0, 500));
  expect_no_page("run.json");
}

TEST_F(ViewCommand, SaysWhichFrameThereIsAndWhatThreeJsIsFor) {
  const ProgramRun late = run("view {0}/shot --frame 3");
  EXPECT_EQ(late.exit_code, 1);
  EXPECT_NE(late.err.find("--frame must be at most 0"), std::string::npos) << late.err;
  const ProgramRun missing = run("view {0}/shot --three-js {0}");
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_NE(missing.err.find("libjs-three"), std::string::npos) << missing.err;
}

TEST_F(ViewCommand, ADetectionIsAPageAsWell) {
  EXPECT_EQ(run("detect {0}/shot/cloud.pcd -o {0}/found --quiet").exit_code, 0);
  EXPECT_EQ(run("view {0}/found").exit_code, 0);
  EXPECT_EQ(run("view {0}/found -o {0}/page.html").exit_code, 0);
  EXPECT_EQ(read_text(folder_ / "page.html"), read_text(folder_ / "found/view.html"));
  EXPECT_EQ(run("detect {0}/shot/cloud.pcd -o {0}/found --keep-clouds 0 --quiet").exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "found/view.html"));  // it is of an older detection
  const ProgramRun without = run("view {0}/found");
  EXPECT_EQ(without.exit_code, 1);
  EXPECT_NE(without.err.find("detection_0000.pcd: is missing"), std::string::npos) << without.err;
}

TEST_F(ViewCommand, WhereAFolderHoldsSeveralResultsOneIsChosen) {
  EXPECT_EQ(run("detect {0}/shot/cloud.pcd -o {0}/shot --quiet").exit_code, 0);
  expect_no_page("holds a capture and a detection: choose one with --show");
  EXPECT_EQ(run("view {0}/shot --show detection").exit_code, 0);
  EXPECT_NE(read_text(folder_ / "shot/view.html").find("FoundStage"), std::string::npos);
  EXPECT_EQ(run("view {0}/shot --show capture").exit_code, 0);
  EXPECT_NE(read_text(folder_ / "shot/view.html").find("CaptureStage"), std::string::npos);
  EXPECT_EQ(run("view {0}/shot --show cup").exit_code, 2);
}

TEST_F(ViewCommand, ExportWritesAModelOrSaysWhyNot) {
  EXPECT_EQ(run("export {0}/scene.json -o {0}/scene.glb").exit_code, 0);
  EXPECT_EQ(read_text(folder_ / "scene.glb").substr(0, 4), "glTF");
  EXPECT_EQ(run("export {0}/scene.json -o {0}/scene.obj").exit_code, 2);
  EXPECT_EQ(run("export {0}/scene.json").exit_code, 2);
  const ProgramRun none = run("export {0}/scene.json --cup 1 -o {0}/cup.glb");
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_NE(none.err.find("has 1 cup,"), std::string::npos) << none.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "cup.glb"));
}

}  // namespace
}  // namespace fathom
