#include "detector/plane.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/units.h"
#include "tests/detector/synthetic.h"

namespace fathom {
namespace {

Points seen(const synthetic::Scene& scene) { return finite_points(synthetic::cast(scene)); }

TEST(DeskPrior, ALevelCameraHasTheDeskBelowAndOneLookingDownAhead) {
  const double height = 0.65;
  const Plane level = plane_from({height, 0.0});
  EXPECT_NEAR(level.height_of({0.0, height, 1.0}), 0.0, 1e-15);  // y points down
  const Plane down = plane_from({height, std::numbers::pi / 2});
  EXPECT_NEAR(down.height_of({0.2, -0.1, height}), 0.0, 1e-15);
  EXPECT_DOUBLE_EQ(down.height_of({0.0, 0.0, 0.0}), height);
}

TEST(DeskPrior, RollLowersTheRightSide) {
  const Plane rolled = plane_from({0.65, 0.5, radians_from_deg(3.0)});
  EXPECT_LT(rolled.height_of({0.1, 0.0, 0.0}), rolled.height_of({-0.1, 0.0, 0.0}));
  EXPECT_NEAR(rolled.normal.norm(), 1.0, 1e-15);
}

TEST(DeskFrame, IsRightHandedWithTheCameraAboveItsOrigin) {
  for (const double pitch_deg : {0.0, 34.0, 58.4, 90.0}) {
    const Plane desk = plane_from({0.65, radians_from_deg(pitch_deg), radians_from_deg(2.0)});
    const Eigen::Isometry3d to_desk = desk_from_camera(desk);
    EXPECT_NEAR(to_desk.linear().determinant(), 1.0, 1e-12) << pitch_deg;  // rounding
    EXPECT_LT((to_desk * Eigen::Vector3d::Zero() - Eigen::Vector3d(0.0, 0.0, 0.65)).norm(), 1e-12) << pitch_deg;
    EXPECT_GT((to_desk.linear() * Eigen::Vector3d::UnitX()).x(), 0.99) << pitch_deg;  // cos 2° and a bit
    EXPECT_NEAR(pitch_above(desk), radians_from_deg(pitch_deg), 0.002)
        << pitch_deg;  // at 90° roll and pitch are one: asin(1 − ε)
  }
}

TEST(Planes, TheDeskComesBackWithItsHeightAndPitch) {
  for (const double distance : {0.2, 0.4, 0.6}) {
    synthetic::Scene scene;
    scene.sensor = synthetic::looking_at(0.65, distance);
    const auto desk = choose_desk(find_planes(seen(scene), {}), std::nullopt, {});
    ASSERT_TRUE(desk);
    EXPECT_NEAR(desk->plane.offset, 0.65, 1e-6);  // single-precision points
    EXPECT_NEAR(pitch_above(desk->plane), scene.sensor.pitch_rad, 1e-6);
    EXPECT_LT(desk->rms_m, 1e-6);
  }
}

TEST(Planes, NoiseOfAMillimetreLeavesTheHeightRightToAHundredth) {
  synthetic::Scene scene;
  scene.noise_m = 0.001;
  const auto desk = choose_desk(find_planes(seen(scene), {}), std::nullopt, {});
  ASSERT_TRUE(desk);
  EXPECT_NEAR(desk->plane.offset, 0.65,
              1e-5 * 5);  // the camera's foot is extrapolated 0.4 m: 5 σ of 1 mm / √70000 × 2.4
  EXPECT_NEAR(desk->rms_m, 0.001 * std::sin(scene.sensor.pitch_rad), 1e-4);  // σ across the plane varies over the view
}

TEST(Planes, TheOneClosestToThePriorIsTheDesk) {
  synthetic::Scene scene;  // a low wide table on the desk, larger in the image than what is left of the desk
  scene.boxes = {{{-0.60, 0.15}, {0.60, 0.80}, 0.08}};
  const std::vector<PlaneFit> planes = find_planes(seen(scene), {});
  const auto desk = choose_desk(planes, DeskPrior{0.655, scene.sensor.pitch_rad}, {});
  ASSERT_TRUE(desk);
  EXPECT_NEAR(desk->plane.offset, 0.65,
              0.005);  // the lowest 10 mm of the box's sides pull; the two planes are 80 mm apart
  const auto largest = choose_desk(planes, std::nullopt, {});
  ASSERT_TRUE(largest);
  EXPECT_NEAR(largest->plane.offset, 0.57, 0.005);
}

TEST(Planes, AWallIsNoDesk) {
  synthetic::Scene scene;
  scene.desk = false;
  scene.sensor = {0.65, radians_from_deg(20.0)};
  scene.boxes = {{{-2.0, 1.5}, {2.0, 1.6}, 3.0}};
  const std::vector<PlaneFit> planes = find_planes(seen(scene), {});
  ASSERT_FALSE(planes.empty());
  EXPECT_FALSE(choose_desk(planes, std::nullopt, {}));
  EXPECT_FALSE(choose_desk(planes, scene.sensor, {}));
}

TEST(Planes, APriorThatIsUpsideDownFindsNoDesk) {
  const std::vector<PlaneFit> planes = find_planes(seen({}), {});
  EXPECT_FALSE(choose_desk(planes, DeskPrior{0.65, -1.0}, {}));
  EXPECT_FALSE(choose_desk(planes, DeskPrior{0.95, 1.02}, {}));
}

TEST(Planes, TooFewPointsHoldNone) {
  EXPECT_TRUE(find_planes({}, {}).empty());
  EXPECT_TRUE(find_planes({{0.0f, 0.0f, 1.0f}}, {}).empty());
  EXPECT_TRUE(find_planes(Points(100, Eigen::Vector3f(0.1f, 0.1f, 1.0f)), {}).empty());  // one place, many times
}

}  // namespace
}  // namespace fathom
