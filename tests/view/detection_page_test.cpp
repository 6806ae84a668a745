// What the page of a detection is given: every point with what it belongs to, and nothing of a damaged folder.
#include <gtest/gtest.h>

#include "core/files.h"
#include "detector/robust.h"
#include "report/detection_report.h"
#include "report/kept_detection.h"
#include "tests/core/expect_error.h"
#include "tests/core/temporary_folder.h"
#include "tests/detector/synthetic.h"
#include "tests/view/unpacked.h"
#include "view/scenes.h"

namespace fathom {
namespace {

/// A folder with what detect writes of a cup that reads 27 mm inside, and of a box beside it.
struct DetectionPage : testing::Test {
  TemporaryFolder folder;
  Json found;

  DetectionPage() {
    synthetic::Scene scene;
    scene.cups = {{.x_m = -0.05, .floor_m = 0.027}};
    scene.boxes = {{{0.1, 0.35}, {0.2, 0.45}, 0.06}};
    const Cloud cloud = synthetic::cast(scene);
    found = detection_json(detect_robust(cloud, DetectorSettings{}));
    KeptDetection kept(folder / "", 1);
    kept.add(cloud);
    kept.finish(found, "");
  }

  /// The folder with this as its detection is refused.
  void expect_refused(const Json& detection, std::initializer_list<std::string> parts) {
    write_json(folder / kDetectionFile, detection);
    expect_error([&] { detection_scene(folder / "", 0); }, parts);
  }
};

TEST_F(DetectionPage, KnowsWhatEachPointBelongsTo) {
  ASSERT_EQ(found["cups"].size(), 1u) << found;
  ASSERT_EQ(found["candidates"].size(), 1u) << found;
  const Json page = detection_scene(folder / "", 0);
  const auto places = unpacked<std::int16_t>(page["points"]);
  const auto owners = unpacked<std::uint16_t>(page["owners"]);
  const double step = page["step_m"];
  ASSERT_EQ(places.size(), 3 * owners.size());
  EXPECT_NEAR(page["cups"][0]["at_m"][0].get<double>(), -0.05, 0.003);
  EXPECT_NEAR(page["cups"][0]["at_m"][1].get<double>(), 0.40, 0.003);
  EXPECT_NEAR(page["cups"][0]["height_mm"].get<double>(), 87.0, 3.0);
  EXPECT_NEAR(page["candidates"][0]["height_mm"].get<double>(), 60.0, 3.0);
  int of_cup = 0, of_box = 0, desk = 0;
  for (std::size_t i = 0; i < owners.size(); ++i) {
    const Eigen::Vector3d at = step * Eigen::Vector3d(places[3 * i], places[3 * i + 1], places[3 * i + 2]);
    const double from_axis = (at.head<2>() - Eigen::Vector2d(-0.05, 0.40)).norm();
    const bool is_wrong = from_axis < 0.038 ? owners[i] != 2 : from_axis > 0.05 && owners[i] == 2;
    EXPECT_FALSE(is_wrong) << at.transpose();
    of_cup += owners[i] == 2;
    of_box += owners[i] == 3 && at.z() > 0.05;
    desk += owners[i] == 1;
    EXPECT_LT(std::abs(at.z()), owners[i] == 1 ? 0.01 : 0.1);
  }
  EXPECT_GT(of_cup, 500);
  EXPECT_GT(of_box, 300);
  EXPECT_GT(desk, 20'000);
}

TEST_F(DetectionPage, TakesNumbersAndWordsAndNothingElse) {
  found["cups"][0]["why"] = "</script><script>alert(1)</script>";
  found["cups"][0]["more"] = "what nobody asked for";
  write_json(folder / kDetectionFile, found);
  const Json page = detection_scene(folder / "", 0);
  EXPECT_EQ(page["cups"][0]["why"], found["cups"][0]["why"]);  // as text; the page escapes it (capture_page_test)
  EXPECT_FALSE(page["cups"][0].contains("more"));
}

TEST_F(DetectionPage, RefusesWhatIsNoDetection) {
  const auto changed = [&](const char* pointer, const Json& value) {
    Json detection = found;
    detection[Json::json_pointer(pointer)] = value;
    return detection;
  };
  expect_refused(changed("/cups/0/radius_mm", nullptr), {"detection.json: /cups/0/radius_mm: must be a number"});
  expect_refused(changed("/cups/0/radius_mm", "wide"), {"/cups/0/radius_mm"});
  expect_refused(changed("/cups/0/height_mm", -1), {"/cups/0/height_mm"});
  expect_refused(changed("/cups/0/center_camera_m", Json{1, 2}), {"/cups/0/center_camera_m"});
  expect_refused(changed("/cups/0/liquid", "perhaps"), {"/cups/0/liquid", "yes, no, unknown"});
  expect_refused(changed("/plane/normal", Json{0, 0, 7}), {"/plane/normal: must have the length 1"});
  expect_refused(changed("/cups", 3), {"/cups: must be a list"});
  expect_refused(changed("/candidates", Json(2000, found["candidates"][0])), {"at most 1000"});
  expect_refused(Json::array(), {"holds no detection"});
}

TEST_F(DetectionPage, SaysWhichCloudThereIs) {
  expect_error([&] { detection_scene(folder / "", 1); }, {"--frame must be at most 0"});
  write_json(folder / kDetectionFile, Json{found, found});
  EXPECT_EQ(detection_scene(folder / "", 0)["cups"].size(), 1u);
  expect_error([&] { detection_scene(folder / "", 1); }, {"detection_0001.pcd: is missing", "--keep-clouds"});
}

TEST_F(DetectionPage, ShowsACloudWithoutADesk) {
  write_json(folder / kDetectionFile,
             {{"plane", nullptr}, {"cups", Json::array()}, {"candidates", Json::array()}, {"why", "no desk"}});
  const Json page = detection_scene(folder / "", 0);
  EXPECT_TRUE(page["desk"].is_null());
  EXPECT_EQ(page["why"], "no desk");
  for (const std::uint16_t owner : unpacked<std::uint16_t>(page["owners"])) ASSERT_EQ(owner, 0);
}

}  // namespace
}  // namespace fathom
