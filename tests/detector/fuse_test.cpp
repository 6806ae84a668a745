// Several views of one desk: what one cannot see another does.
#include "detector/fuse.h"

#include <gtest/gtest.h>

#include "detector/fill.h"
#include "detector/robust.h"
#include "tests/detector/synthetic.h"

namespace fathom {
namespace {

using synthetic::OpenCup;
using synthetic::Scene;

Scene scene_of(double distance_m, double height_m) {
  Scene scene;
  scene.width = 640, scene.height = 480, scene.focal_px = 570.342, scene.noise_m = 0.001;
  scene.sensor = synthetic::looking_at(height_m, distance_m);
  return scene;
}

/// The world is the synthetic scenes': below the first camera, y away from it.
PosedDetection view_of(const Scene& scene) {
  return {detect_robust(synthetic::cast(scene), {}),
          Eigen::AngleAxisd(scene.yaw_rad, Eigen::Vector3d::UnitZ()) * desk_from_camera(plane_from(scene.sensor))};
}

TEST(FusedViews, ACupThatOneViewCannotSeeIsFoundByTheOther) {
  Scene hidden = scene_of(0.40, 0.35);
  OpenCup cup;
  cup.y_m = 0.55;
  hidden.cups = {cup};
  hidden.boxes = {{{-0.10, 0.40}, {0.10, 0.50}, 0.12}};  // in front of it
  Scene open = hidden;
  open.sensor = synthetic::looking_at(0.90, 0.50);
  const PosedDetection first = view_of(hidden), second = view_of(open);
  ASSERT_TRUE(first.detection.cups.empty());
  ASSERT_EQ(second.detection.cups.size(), 1u);
  const Detection both = fuse_views({first, second}, {});
  ASSERT_EQ(both.cups.size(), 1u);
  const Eigen::Vector3d in_world = first.world_from_camera * both.cups[0].center_in_camera;
  EXPECT_LT((in_world - Eigen::Vector3d(0.0, 0.55, 0.045)).norm(), 0.004);  // a wall's thickness, and noise
}

/// What a cup with a floor at this height reads like from low and from high above, fused.
DetectedCup fused_cup(double floor_low_m, double floor_high_m) {
  OpenCup cup;
  cup.y_m = 0.30;
  Scene low = scene_of(0.30, 0.50), high = scene_of(0.30, 0.80);
  high.sensor = {0.80, 1.45};  // looks almost straight down
  cup.floor_m = floor_low_m;
  low.cups = {cup};
  cup.floor_m = floor_high_m;
  high.cups = {cup};
  const Detection both = fuse_views({view_of(low), view_of(high)}, {});
  EXPECT_EQ(both.cups.size(), 1u);
  return both.cups.at(0);
}

TEST(FusedViews, EachCupIsThereOnceWithTheEvidenceOfAll) {
  const DetectedCup cup = fused_cup(0.006, 0.006);
  ASSERT_TRUE(cup.evidence);
  EXPECT_EQ(cup.evidence->readings.size(), 2u);
  EXPECT_EQ(cup.liquid, Liquid::kNo) << cup.why;
  EXPECT_EQ(cup.why.rfind("seen in 2 views", 0), 0u) << cup.why;
}

TEST(FusedViews, AnOpaqueSurfaceStandsStillBetweenViews) {
  const DetectedCup cup = fused_cup(0.036, 0.036);
  EXPECT_EQ(cup.liquid, Liquid::kYes) << cup.why;
  EXPECT_EQ(cup.kind, LiquidKind::kOpaque) << cup.why;
  ASSERT_TRUE(cup.fill_m);
  EXPECT_NEAR(*cup.fill_m, 0.030, 2.0 * *cup.fill_sigma_m);
}

TEST(FusedViews, ViewsWithoutADeskDoNoHarm) {
  const PosedDetection nothing{detect_robust({}, {}), Pose::Identity()};
  EXPECT_FALSE(fuse_views({nothing}, {}).desk);
  Scene scene = scene_of(0.40, 0.65);
  scene.cups = {OpenCup{}};
  EXPECT_EQ(fuse_views({nothing, view_of(scene)}, {}).cups.size(), 1u);
}

}  // namespace
}  // namespace fathom
