#include "detector/cup_template.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/files.h"
#include "detector/make_template.h"
#include "tests/detector/synthetic.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

CupTemplate captured(double lateral_m, std::optional<double> threshold_m) {
  synthetic::Scene scene;
  synthetic::OpenCup cup;
  cup.x_m = lateral_m;
  scene.cups = {cup};
  const DeskView view = std::get<DeskView>(view_of_desk(synthetic::cast(scene), scene.sensor, {}));
  return make_template("cup", view, cup_candidates(view, {}).at(0), {}, threshold_m);
}

struct TemplateFiles : testing::Test {
  fs::path folder = fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
  void SetUp() override { make_directory(folder); }
  void TearDown() override { fs::remove_all(folder); }
  std::string error_of(const std::string& json) {
    write_text(folder / "cup.json", json);
    try {
      load_template(folder / "cup.json");
    } catch (const Error& problem) {
      return problem.what();
    }
    return "";
  }
};

TEST(CupTemplate, StandsOnItsOriginWithTheCameraAtNegativeY) {
  for (const double lateral : {-0.15, 0.0, 0.15}) {
    const CupTemplate cup = captured(lateral, 0.009);
    Eigen::Vector3f mean = Eigen::Vector3f::Zero();
    for (const Eigen::Vector3f& point : cup.points) {
      EXPECT_LT(point.head<2>().norm(), 0.0455f);  // outer radius 43 mm, and half the difference of the walls' radii
      EXPECT_GT(point.z(), 0.0065f);               // the bottom stands at 7 mm
      EXPECT_LT(point.z(), 0.0875f);
      mean += point / static_cast<float>(cup.points.size());
    }
    EXPECT_NEAR(mean.x(), 0.0f, 0.003f);  // seen symmetrically, to the template's spacing
  }
}

TEST(CupTemplate, TheThresholdIs2MillimetresAboveTheBottomThatIsSeen) {
  EXPECT_NEAR(captured(0.0, std::nullopt).liquid_threshold_m, 0.009, 1e-4);  // the desk's plane, see PaperMethod
  EXPECT_EQ(captured(0.0, 0.006).liquid_threshold_m, 0.006);
}

TEST(CupTemplate, WithoutABottomTheThresholdMustBeGiven) {
  synthetic::Scene scene;
  scene.sensor = synthetic::looking_at(0.65, 0.60);
  synthetic::OpenCup cup;
  cup.y_m = 0.60;
  scene.cups = {cup};
  const DeskView view = std::get<DeskView>(view_of_desk(synthetic::cast(scene), scene.sensor, {}));
  EXPECT_THROW(make_template("cup", view, cup_candidates(view, {}).at(0), {}, std::nullopt), Error);
}

TEST_F(TemplateFiles, WhatIsSavedIsLoaded) {
  const CupTemplate saved = captured(0.0, 0.009);
  save_template(folder, saved);
  const std::vector<CupTemplate> loaded = load_templates(folder);
  ASSERT_EQ(loaded.size(), 1u);
  EXPECT_EQ(loaded[0].name, saved.name);
  EXPECT_EQ(loaded[0].points, saved.points);
  EXPECT_NEAR(loaded[0].radius_m, saved.radius_m, 5.1e-6);  // the file has hundredths of a millimetre
  EXPECT_NEAR(loaded[0].height_m, saved.height_m, 5.1e-6);
  EXPECT_NEAR(loaded[0].liquid_threshold_m, saved.liquid_threshold_m, 1e-15);
}

TEST_F(TemplateFiles, MistakesNameFileAndKey) {
  const std::string file = (folder / "cup.json").string();
  save_template(folder, captured(0.0, 0.009));
  EXPECT_EQ(error_of(R"({"name": "cup", "cloud": "cup.pcd", "height_mm": 87, "radius_mm": 43})"),
            file + ": /liquid_threshold_mm: is missing");
  EXPECT_EQ(
      error_of(R"({"name": "cup", "cloud": "cup.pcd", "liquid_threshold_mm": -1, "height_mm": 87, "radius_mm": 43})"),
      file + ": /liquid_threshold_mm: must be a number above 0, got -1");
  EXPECT_EQ(
      error_of(R"({"name": "cup", "cloud": "no.pcd", "liquid_threshold_mm": 9, "height_mm": 87, "radius_mm": 43})"),
      (folder / "no.pcd").string() + ": no such file");
  EXPECT_THROW(load_templates(folder / "nowhere"), Error);
}

}  // namespace
}  // namespace fathom
