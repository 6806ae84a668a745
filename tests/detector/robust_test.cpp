// The robust method on ideal clouds: what the printed one fails at, and every cloud that may come.
#include "detector/robust.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/rng.h"
#include "core/units.h"
#include "tests/detector/synthetic.h"
#include "tests/detector/why_no_desk.h"

namespace fathom {
namespace robust_test {

using synthetic::cast;
using synthetic::OpenCup;
using synthetic::Scene;

/// As a template, a cup whose bottom is 7 mm above the desk.
CupTemplate paper_cup() {
  CupTemplate cup{"paper_cup", {}, 0.009, 0.087, 0.0415};
  for (float x = -0.03f; x <= 0.03f; x += 0.002f) cup.points.emplace_back(x, 0.0f, 0.007f);
  return cup;
}

Detection detect(const Cloud& cloud, std::optional<DeskPrior> prior = std::nullopt) {
  DetectorSettings settings;
  settings.prior = prior;
  settings.templates = {paper_cup()};
  return detect_robust(cloud, settings);
}

/// As a Xtion's cloud: 640 × 480, with a millimetre of noise.
Scene noisy() {
  Scene scene;
  scene.width = 640, scene.height = 480;
  scene.focal_px = 570.342;
  scene.noise_m = 0.001;
  return scene;
}

OpenCup cup_at(double x_m, double y_m, double floor_m = 0.007) {
  OpenCup cup;
  cup.x_m = x_m, cup.y_m = y_m, cup.floor_m = floor_m;
  return cup;
}

Scene one_cup(double distance_m, double floor_m) {
  Scene scene = noisy();
  scene.sensor = synthetic::looking_at(0.65, distance_m);
  scene.cups = {cup_at(0.0, distance_m, floor_m)};
  return scene;
}

/// The found cup nearest to a place of the desk, at most 3 mm from it: the wall's thickness.
const DetectedCup* cup_near(const Detection& detection, double x_m, double y_m) {
  for (const DetectedCup& cup : detection.cups)
    if ((cup.candidate.circle->center - Eigen::Vector2d(x_m, y_m)).norm() < 0.003) return &cup;
  return nullptr;
}

void expect_paper_cup(const Detection& detection, double x_m, double y_m) {
  const DetectedCup* cup = cup_near(detection, x_m, y_m);
  ASSERT_TRUE(cup) << x_m << " " << y_m;
  EXPECT_NEAR(cup->candidate.circle->radius_m, 0.0415, 0.0015);  // between the two walls
  EXPECT_NEAR(cup->candidate.top_m, 0.087, 0.003);               // noise of 1 mm, and the highest count
}

TEST(Robust, FindsTheCupAndWhatStandsInIt) {
  for (const double distance : {0.2, 0.3, 0.4}) {
    for (const double floor : {0.007, 0.010, 0.017, 0.037}) {
      const Scene scene = one_cup(distance, floor);
      const Detection result = detect(cast(scene), scene.sensor);
      EXPECT_EQ(result.segments, 1);
      ASSERT_EQ(result.cups.size(), 1u) << distance << " " << floor;
      expect_paper_cup(result, 0.0, distance);
      const DetectedCup& cup = result.cups[0];
      ASSERT_TRUE(cup.interior) << distance << " " << floor;
      EXPECT_NEAR(cup.interior->mean_m, floor, 3.0 * *cup.surface_sigma_m);
      EXPECT_EQ(cup.liquid, floor > 0.009 ? Liquid::kYes : Liquid::kNo) << distance << " " << floor << cup.why;
    }
  }
}

TEST(Robust, CupsThatTouchAreTwo) {
  for (const double gap : {0.0, 0.005, 0.030}) {
    Scene scene = noisy();
    scene.cups = {cup_at(-0.043 - 0.5 * gap, 0.40), cup_at(0.043 + 0.5 * gap, 0.42)};
    const Detection result = detect(cast(scene));
    EXPECT_EQ(result.cups.size(), 2u) << gap;
    for (const OpenCup& cup : scene.cups) expect_paper_cup(result, cup.x_m, cup.y_m);
  }
}

TEST(Robust, ACupBesideABoxOrHalfHiddenByOneIsFound) {
  Scene beside = noisy();
  beside.cups = {cup_at(0.0, 0.40)};
  beside.boxes = {{{0.043, 0.35}, {0.15, 0.45}, 0.12}, {{-0.14, 0.38}, {-0.044, 0.44}, 0.06}};
  expect_paper_cup(detect(cast(beside)), 0.0, 0.40);

  Scene behind = noisy();
  behind.cups = {cup_at(0.0, 0.45)};
  behind.boxes = {{{-0.20, 0.30}, {-0.01, 0.36}, 0.10}};  // hides the left half of the near wall
  const Detection result = detect(cast(behind));
  EXPECT_EQ(result.cups.size(), 1u);
  expect_paper_cup(result, 0.0, 0.45);
}

TEST(Robust, ClosedAndTallThingsThatTouchCupsLeaveThemCups) {
  Scene scene = noisy();
  OpenCup can = cup_at(-0.078, 0.40, 0.118);  // its lid is full of circles
  can.height_m = 0.122, can.inner_radius_m = 0.031, can.outer_radius_m = 0.033;
  OpenCup other = can;
  other.x_m = 0.020, other.y_m = 0.48;
  scene.cups = {can, other, cup_at(0.0, 0.39), cup_at(0.10, 0.36)};
  scene.boxes = {{{0.145, 0.30}, {0.20, 0.42}, 0.16}};
  const Detection result = detect(cast(scene));
  EXPECT_EQ(result.cups.size(), 2u);
  expect_paper_cup(result, 0.0, 0.39);
  expect_paper_cup(result, 0.10, 0.36);
}

TEST(Robust, WhatIsHeapedOrLeansIsNoLiquid) {
  // Sugar stands up to 35 deg; a mound of 10 deg rises 7 mm from the wall to the tip.
  for (const double slope_deg : {10.0, 20.0, 30.0}) {
    for (const bool mound : {true, false}) {
      Scene scene = one_cup(0.30, 0.040);
      (mound ? scene.cups[0].mound_slope : scene.cups[0].lean_slope) = std::tan(radians_from_deg(slope_deg));
      const Detection result = detect(cast(scene));
      ASSERT_EQ(result.cups.size(), 1u) << slope_deg << mound;
      const DetectedCup& cup = result.cups[0];
      EXPECT_EQ(cup.liquid, Liquid::kUnknown) << slope_deg << mound << cup.why;
      EXPECT_NE(cup.why.find("solid?"), std::string::npos) << slope_deg << mound << cup.why;
    }
  }
  Scene level = one_cup(0.30, 0.040);
  EXPECT_EQ(detect(cast(level)).cups.at(0).liquid, Liquid::kYes);
}

TEST(Robust, AHandleDoesNotMoveTheCircle) {
  Scene scene = noisy();
  scene.cups = {cup_at(0.0, 0.40)};
  const auto circle = [&] { return *detect(cast(scene)).cups.at(0).candidate.circle; };
  const Circle without = circle();
  scene.boxes = {{{0.042, 0.395}, {0.075, 0.405}, 0.075}};
  const Circle with = circle();
  EXPECT_NEAR(with.radius_m, without.radius_m, 0.0005);  // the plain fit grows by 6 mm
  EXPECT_LT((with.center - without.center).norm(), 0.0005);
}

TEST(Robust, WhatIsClosedAtTheTopIsNoCup) {
  for (const double below_rim : {0.0, 0.003, 0.006}) {  // inverted mugs, cans, mugs with a foot ring
    Scene scene = noisy();
    scene.cups = {cup_at(0.0, 0.40, 0.087 - below_rim)};
    const Detection result = detect(cast(scene));
    EXPECT_TRUE(result.cups.empty()) << below_rim;
    ASSERT_FALSE(result.rejected.empty());
    for (const RejectedSegment& segment : result.rejected)
      EXPECT_EQ(segment.candidate.rejected.rfind("closed at the top", 0), 0u) << segment.candidate.rejected;
  }
  Scene boxes = noisy();
  boxes.boxes = {{{-0.15, 0.35}, {-0.05, 0.45}, 0.09}, {{0.05, 0.40}, {0.09, 0.44}, 0.10}};
  EXPECT_TRUE(detect(cast(boxes)).cups.empty());
}

TEST(Robust, WideAndTallVesselsAreNoCups) {
  Scene pot = noisy();
  pot.cups = {cup_at(0.0, 0.45, 0.004)};
  pot.cups[0].inner_radius_m = 0.083, pot.cups[0].outer_radius_m = 0.086;
  const Detection open = detect(cast(pot));
  EXPECT_TRUE(open.cups.empty());
  ASSERT_EQ(open.rejected.size(), 1u);
  EXPECT_EQ(open.rejected[0].candidate.rejected.rfind("radius", 0), 0u);
  ASSERT_TRUE(open.rejected[0].interior);  // what is seen in it is told all the same
  EXPECT_NEAR(open.rejected[0].interior->mean_m, 0.004, 0.0005);
  Scene vase = noisy();
  vase.cups = {cup_at(0.0, 0.45)};
  vase.cups[0].height_m = 0.25;
  EXPECT_TRUE(detect(cast(vase)).cups.empty());
}

TEST(Robust, ABottomThatIsHiddenIsUnknown) {
  Scene scene = one_cup(0.65, 0.007);
  const Detection result = detect(cast(scene));
  ASSERT_EQ(result.cups.size(), 1u);
  EXPECT_FALSE(result.cups[0].interior);
  EXPECT_FALSE(result.cups[0].p_liquid);
  EXPECT_EQ(result.cups[0].liquid, Liquid::kUnknown);
}

TEST(Robust, APoseThatTurnsTheCameraAboutItsLineOfSightDoesNotMatter) {
  const Cloud cloud = cast(one_cup(0.40, 0.017));
  for (const float roll : {0.5f, 1.6f, 3.14159f}) {  // to the side; upside down
    Cloud rolled = cloud;
    for (Eigen::Vector3f& point : rolled.points) point = Eigen::AngleAxisf(roll, Eigen::Vector3f::UnitZ()) * point;
    const Detection result = detect(rolled);
    ASSERT_EQ(result.cups.size(), 1u) << roll;
    EXPECT_NEAR(result.cups[0].interior->mean_m, 0.017, 3.0 * *result.cups[0].surface_sigma_m);
  }
}

TEST(Robust, TheOrderOfThePointsDoesNotMatterNorDoesTheirRaster) {
  const Cloud cloud = cast(one_cup(0.40, 0.017));
  Cloud shuffled{.points = finite_points(cloud), .intensity = {}, .width = 0, .height = 1};
  Rng rng(1);
  for (std::size_t i = shuffled.points.size(); i > 1; --i)
    std::swap(shuffled.points[i - 1], shuffled.points[rng.below(static_cast<std::uint32_t>(i))]);
  shuffled.width = static_cast<int>(shuffled.points.size());
  const Detection a = detect(cloud), b = detect(shuffled);
  ASSERT_EQ(a.cups.size(), 1u);
  ASSERT_EQ(b.cups.size(), 1u);
  // Other draws: far below the noise of 1 mm.
  EXPECT_NEAR(a.cups[0].candidate.circle->radius_m, b.cups[0].candidate.circle->radius_m, 2e-4);
  EXPECT_NEAR(a.cups[0].interior->mean_m, b.cups[0].interior->mean_m, 2e-4);
}

TEST(Robust, EqualCloudsGiveEqualResults) {
  const Cloud cloud = cast(one_cup(0.40, 0.017));
  const Detection a = detect(cloud), b = detect(cloud);
  ASSERT_EQ(a.cups.size(), 1u);
  EXPECT_EQ(a.cups[0].center_in_camera, b.cups[0].center_in_camera);
  EXPECT_EQ(a.cups[0].interior->mean_m, b.cups[0].interior->mean_m);
  EXPECT_EQ(a.desk->plane.offset, b.desk->plane.offset);
}

TEST(Robust, TenMillionPointsAreAnsweredAsOne) {
  const Cloud once = cast(one_cup(0.40, 0.017));
  Cloud many{.points = {}, .intensity = {}, .width = 0, .height = 1};
  while (many.points.size() < 10'000'000) many.points.insert(many.points.end(), once.points.begin(), once.points.end());
  many.width = static_cast<int>(many.points.size());
  const Detection a = detect(once), b = detect(many);
  ASSERT_EQ(b.cups.size(), 1u);
  EXPECT_NEAR(a.cups[0].candidate.circle->radius_m, b.cups[0].candidate.circle->radius_m, 2e-4);
  EXPECT_NEAR(a.cups[0].interior->mean_m, b.cups[0].interior->mean_m, 2e-4);
}

TEST(Robust, CloudsWithoutADeskSaySo) {
  const Eigen::Vector3f nothing = Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(why_no_desk(detect({})), "no desk: the cloud has 0 measured points");
  EXPECT_EQ(why_no_desk(detect({Points(64, nothing), {}, 8, 8})), "no desk: the cloud has 0 measured points");
  EXPECT_EQ(why_no_desk(detect({{{0.0f, 0.0f, 1.0f}}, {}, 1, 1})), "no desk: the cloud has 1 measured points");
  EXPECT_EQ(why_no_desk(detect({Points(64, {0.0f, 0.0f, 1.0f}), {}, 64, 1})),
            "no desk: no plane of 3 % of the points lies in the cloud");
  EXPECT_EQ(why_no_desk(detect(cast(one_cup(0.4, 0.007)), DeskPrior{0.65, -1.0})),
            "no desk: no plane of 3 % of the points lies where the sensor's height and pitch put it");
}

TEST(Robust, ADeskAloneHasNoCups) {
  const Detection result = detect(cast(noisy()));
  ASSERT_TRUE(result.desk);
  EXPECT_TRUE(result.cups.empty());
  EXPECT_EQ(result.segments, 0);
}

}  // namespace robust_test
}  // namespace fathom
