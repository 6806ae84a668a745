// The printed method on ideal clouds of the paper's cup: what it promises, and where it is known to fail.
#include "detector/paper.h"
#include "detector/make_template.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "tests/detector/synthetic.h"
#include "tests/detector/why_no_desk.h"

namespace fathom {
namespace paper_test {

using synthetic::cast;
using synthetic::OpenCup;
using synthetic::Scene;

/// The template every test matches against: the empty cup seen straight ahead at 400 mm.
const CupTemplate& paper_cup() {
  static const CupTemplate cup = [] {
    Scene scene;
    scene.cups = {OpenCup{}};
    const DeskView view = std::get<DeskView>(view_of_desk(cast(scene), scene.sensor, {}));
    return make_template("paper_cup", view, cup_candidates(view, {}).at(0), {}, 0.009);
  }();
  return cup;
}

Detection detect(const Cloud& cloud, std::optional<DeskPrior> prior = std::nullopt) {
  return detect_paper(cloud, {prior, {paper_cup()}, {}});
}

Scene one_cup(double distance_m, double floor_m) {
  Scene scene;
  scene.sensor = synthetic::looking_at(0.65, distance_m);
  OpenCup cup;
  cup.y_m = distance_m;
  cup.floor_m = floor_m;
  scene.cups = {cup};
  return scene;
}

TEST(PaperMethod, FindsTheCupWhereItStands) {
  const Scene scene = one_cup(0.40, 0.007);
  const Detection result = detect(cast(scene), scene.sensor);
  EXPECT_EQ(result.segments, 1);
  ASSERT_EQ(result.cups.size(), 1u);
  const DetectedCup& cup = result.cups[0];
  // The near half shows the outer wall, the far half the inner one: the circle lies between the two and a bit nearer.
  EXPECT_GT(cup.candidate.circle->radius_m, 0.040);
  EXPECT_LT(cup.candidate.circle->radius_m, 0.043);
  const Eigen::Vector3d truth =
      desk_from_camera(plane_from(scene.sensor)).inverse() * Eigen::Vector3d(0.0, 0.40, 0.045);
  EXPECT_LT((cup.center_in_camera - truth).norm(), 0.002);  // half of the wall's 3 mm, and the pixels
  EXPECT_LT(cup.score_m, 0.002);                            // the template's spacing is 3 mm
}

TEST(PaperMethod, TheHeightInsideIsWhatStandsThere) {
  for (const double distance : {0.2, 0.3, 0.4, 0.5}) {
    for (const double floor : {0.007, 0.011, 0.017, 0.037}) {
      const Scene scene = one_cup(distance, floor);
      const Detection result = detect(cast(scene), scene.sensor);
      ASSERT_EQ(result.cups.size(), 1u) << distance << " " << floor;
      if (!result.cups[0].interior) continue;  // few pixels see the bottom at half the Xtion's resolution from 500 mm
      // The bottom's points within 10 mm of the desk pull the plane up by their share of it.
      EXPECT_NEAR(result.cups[0].interior->mean_m, floor, 1e-4) << distance;
      EXPECT_EQ(result.cups[0].liquid, floor > 0.009 ? Liquid::kYes : Liquid::kNo) << distance << " " << floor;
      EXPECT_EQ(result.cups[0].kind, LiquidKind::kUnknown);
      EXPECT_FALSE(result.cups[0].fill_m);
    }
  }
}

TEST(PaperMethod, At600MillimetresTheBottomIsHiddenAndTheAnswerUnknown) {
  const Detection result = detect(cast(one_cup(0.60, 0.007)));
  ASSERT_EQ(result.cups.size(), 1u);
  EXPECT_FALSE(result.cups[0].interior);
  EXPECT_EQ(result.cups[0].liquid, Liquid::kUnknown);
}

TEST(PaperMethod, CupsWithAGapAbove40MillimetresAreTwoSegmentsAndBelowItOneThatIsNotRecognised) {
  const auto with_gap = [](double gap) {
    Scene scene;
    OpenCup left, right;
    left.x_m = -0.5 * gap - left.outer_radius_m;
    right.x_m = -left.x_m;
    scene.cups = {left, right};
    return detect(cast(scene));
  };
  EXPECT_EQ(with_gap(0.060).segments, 2);
  EXPECT_EQ(with_gap(0.060).cups.size(), 2u);
  const Detection merged = with_gap(0.030);  // the paper's Fig. 17
  EXPECT_EQ(merged.segments, 1);
  EXPECT_TRUE(merged.cups.empty());
  ASSERT_EQ(merged.rejected.size(), 1u);
  EXPECT_NE(merged.rejected[0].candidate.rejected.find("width"), std::string::npos);
}

TEST(PaperMethod, AWideBoxIsNoCup) {
  Scene scene;
  scene.boxes = {{{-0.15, 0.35}, {0.15, 0.45}, 0.09}};
  const Detection result = detect(cast(scene));
  EXPECT_EQ(result.segments, 1);
  EXPECT_TRUE(result.cups.empty());
}

TEST(PaperMethod, OtherShapesAreFarFromTheTemplateAndKeptAsEvidence) {
  Scene scene = one_cup(0.40, 0.007);
  scene.cups[0].height_m = 0.097;
  DetectorSettings settings{scene.sensor, {paper_cup()}, {}};
  settings.paper.icp.score_max_m = 1e-4;  // only the template itself is that close
  const Detection result = detect_paper(cast(scene), settings);
  EXPECT_TRUE(result.cups.empty());
  ASSERT_EQ(result.rejected.size(), 1u);
  EXPECT_TRUE(result.rejected[0].match);
  EXPECT_NE(result.rejected[0].candidate.rejected.find("paper_cup"), std::string::npos);
  settings.templates.clear();
  EXPECT_EQ(detect_paper(cast(scene), settings).rejected.at(0).candidate.rejected, "there is no template to match");
}

/// One noisy cup, so that nothing agrees by being exact.
Cloud noisy_cup() {
  Scene scene = one_cup(0.40, 0.017);
  scene.noise_m = 0.001;
  return cast(scene);
}

void expect_same(const Detection& a, const Detection& b, double tolerance_m) {
  ASSERT_EQ(a.cups.size(), 1u);
  ASSERT_EQ(b.cups.size(), 1u);
  EXPECT_EQ(a.cups[0].liquid, b.cups[0].liquid);
  EXPECT_NEAR(a.cups[0].interior->mean_m, b.cups[0].interior->mean_m, tolerance_m);
  EXPECT_NEAR(a.cups[0].candidate.circle->radius_m, b.cups[0].candidate.circle->radius_m, tolerance_m);
  EXPECT_NEAR(a.cups[0].score_m, b.cups[0].score_m, tolerance_m);
}

// RANSAC draws other samples, so the 10 mm slice of noisy desk points changes a little: far below the noise of 1 mm.
constexpr double kOtherSamplesMetres = 1e-4;

TEST(PaperMethod, EqualCloudsGiveEqualResults) {
  const Cloud cloud = noisy_cup();
  const Detection a = detect(cloud), b = detect(cloud);
  expect_same(a, b, 0.0);
  EXPECT_EQ(a.desk->plane.offset, b.desk->plane.offset);
  EXPECT_EQ(a.cups[0].center_in_camera, b.cups[0].center_in_camera);
}

TEST(PaperMethod, TheOrderOfThePointsDoesNotMatter) {
  const Cloud cloud = noisy_cup();
  Cloud reversed = cloud;
  std::reverse(reversed.points.begin(), reversed.points.end());
  expect_same(detect(cloud), detect(reversed), kOtherSamplesMetres);
}

TEST(PaperMethod, PointsGivenTwiceDoNotMatter) {
  const Cloud cloud = noisy_cup();
  Cloud twice = cloud;
  twice.points.insert(twice.points.end(), cloud.points.begin(), cloud.points.end());
  twice.height *= 2;
  expect_same(detect(cloud), detect(twice), kOtherSamplesMetres);
}

TEST(PaperMethod, TurningTheSceneAboutTheVerticalThroughTheCameraDoesNotMatter) {
  const Cloud cloud = noisy_cup();
  Cloud turned = cloud;
  const Eigen::AngleAxisf turn(0.4f, plane_from(Scene{}.sensor).normal.cast<float>());
  for (Eigen::Vector3f& point : turned.points) point = turn * point;
  expect_same(detect(cloud), detect(turned), kOtherSamplesMetres);
}

TEST(PaperMethod, CloudsWithoutADeskSaySo) {
  const Eigen::Vector3f nothing = Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(why_no_desk(detect({})), "no desk: the cloud has 0 measured points");
  EXPECT_EQ(why_no_desk(detect({Points(64, nothing), {}, 8, 8})), "no desk: the cloud has 0 measured points");
  EXPECT_EQ(why_no_desk(detect({{{0.0f, 0.0f, 1.0f}}, {}, 1, 1})), "no desk: the cloud has 1 measured points");
  EXPECT_EQ(why_no_desk(detect({Points(64, {0.0f, 0.0f, 1.0f}), {}, 64, 1})),
            "no desk: none of 0 planes lies below the camera");
  EXPECT_EQ(why_no_desk(detect(noisy_cup(), DeskPrior{0.65, -1.0})),
            "no desk: none of 1 planes lies where the sensor's height and pitch put it");
}

TEST(Methods, EachAnswersAnEmptyCloudAndADeskWithoutAnything) {
  for (const Method& method : methods()) {
    const DetectorSettings settings{std::nullopt, {paper_cup()}, {}};
    EXPECT_EQ(method.detect({}, settings).why, "no desk: the cloud has 0 measured points") << method.name;
    const Detection bare = method.detect(cast(Scene{}), settings);
    EXPECT_TRUE(bare.desk) << method.name;
    EXPECT_TRUE(bare.cups.empty()) << method.name;
  }
}

TEST(Methods, AnUnknownNameListsTheChoices) {
  EXPECT_EQ(method_named("paper").name, "paper");
  try {
    method_named("papre");
    FAIL();
  } catch (const Error& problem) {
    EXPECT_STREQ(problem.what(),
                 "unknown method 'papre', choose from robust, paper, sac-ia, prerejective; "
                 "did you mean 'paper'?");
  }
}

}  // namespace paper_test
}  // namespace fathom
