// What a frame says of a desk, and where it cannot.
#include "diagnosis/measurement/frame_estimates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/units.h"
#include "diagnosis/measurement/cup_regions.h"
#include "diagnosis/measurement/sensed_frame.h"
#include "tests/diagnosis/measurement/tilted_desk.h"

namespace fathom {
namespace {

/// A desk 0.7 m below a sensor on which ten rows are half a pixel of disparity apart: f b cos(pitch) / (f h).
std::vector<SensedPoint> desk_of_rows(const LaboratoryRig& rig, int every) {
  std::vector<SensedPoint> points;
  for (int row = every / 2; row < 480; row += every)
    for (int column = 0; column < 640; column += every) {
      const double u = (column + 0.5 - 320.0) / rig.focal_px, v = (row + 0.5 - 240.0) / rig.focal_px;
      const double z = rig.height_m / (std::sin(rig.pitch_rad) + v * std::cos(rig.pitch_rad));
      points.push_back({(z * Eigen::Vector3d(u, v, 1.0)).cast<float>(), 0.0f});
    }
  return points;
}

/// Codes of 1/2 px show where disparities stand: not where rows do so by themselves.
TEST(FrameEstimates, TellNothingOfCodesWhereRowsAreWholeCodesApart) {
  LaboratoryRig rig;
  rig.height_m = 0.700;
  rig.pitch_rad = std::acos(0.05 * rig.height_m / rig.baseline_m);
  const auto spans_codes = [&](int every) { return estimate_frame(desk_of_rows(rig, every), rig, {})->spans_codes; };
  EXPECT_TRUE(spans_codes(1));
  EXPECT_TRUE(spans_codes(7));
  EXPECT_FALSE(spans_codes(10));
}

/// A fifth of a cup's inside, spread evenly, lies 20 mm above the rest.
TEST(FrameEstimates, SayWhichShareOfHeightsStraysFromTheirMedian) {
  const LaboratoryRig rig = laboratory();
  const Eigen::Vector2d cup(0.0, 0.3);
  std::vector<SensedPoint> points = desk_of_rows(rig, 1);
  const Eigen::Isometry3d to_desk = desk_from_camera(plane_from(DeskPrior{rig.height_m, rig.pitch_rad, rig.roll_rad}));
  std::size_t number = 0;
  for (SensedPoint& sensed : points) {
    Eigen::Vector3d p = to_desk * sensed.point.cast<double>();
    if ((p.head<2>() - axis_from_camera(rig, cup)).norm() > interior_radius(rig.cup)) continue;
    p.z() = number++ % 5 == 0 ? 0.040 : 0.020;
    sensed.point = (to_desk.inverse() * p).cast<float>();
  }
  FrameView view;
  view.cup = cup;
  const auto estimates = estimate_frame(points, rig, view);
  ASSERT_TRUE(estimates);
  for (const RegionEstimate& region : estimates->height) {
    EXPECT_NEAR(region.mean, 0.020, 0.0002);
    EXPECT_NEAR(region.stray_share(), 0.2, 0.02);
  }
}

/// Pixels that points stand for, of all and of those as near to a cup's axis as counts for the cup.
struct Pixels {
  double all = 0.0, near = 0.0;
  std::size_t near_points = 0;
};
Pixels pixels_of(const std::vector<SensedPoint>& points, const LaboratoryRig& rig, const Eigen::Vector2d& cup) {
  const Eigen::Isometry3d to_desk = desk_from_camera(plane_from(DeskPrior{rig.height_m, rig.pitch_rad, rig.roll_rad}));
  Pixels pixels;
  for (const SensedPoint& sensed : points) {
    const Eigen::Vector3d p = to_desk * sensed.point.cast<double>();
    pixels.all += sensed.weight;
    if ((p.head<2>() - axis_from_camera(rig, cup)).norm() > clear_of_cup(rig)) continue;
    pixels.near += sensed.weight;
    ++pixels.near_points;
  }
  return pixels;
}

/// The same as an organised cloud, in which some pixels saw nothing.
Cloud cloud_of(const std::vector<SensedPoint>& points, std::size_t holes) {
  Cloud cloud;
  for (const SensedPoint& sensed : points) cloud.points.push_back(sensed.point);
  for (std::size_t i = 0; i < holes; ++i) cloud.points[1000 * i].setConstant(NAN);
  cloud.width = 640;
  cloud.height = 480;
  return cloud;
}

TEST(DeskThinned, KeepsTheCupWholeAndThePixelsThatTheDeskCovers) {
  LaboratoryRig rig;
  rig.height_m = 0.650;
  rig.pitch_rad = radians_from_deg(58.0);
  const FrameView view{Eigen::Vector2d(0.05, 0.4), 0.0};
  const std::vector<SensedPoint> whole = desk_of_rows(rig, 1);
  const auto thinned = [&](std::size_t holes) {
    const Cloud cloud = cloud_of(whole, holes);
    return with_desk_thinned(cloud, sensed_points(cloud, rig), rig, view);
  };
  const std::vector<SensedPoint> some = thinned(0);
  const Pixels before = pixels_of(whole, rig, *view.cup), after = pixels_of(some, rig, *view.cup);
  EXPECT_LT(some.size(), whole.size() / 4);
  EXPECT_GT(after.near_points, 1000u);
  EXPECT_EQ(after.near_points, before.near_points);
  EXPECT_EQ(after.near, before.near);
  EXPECT_NEAR(after.all, before.all, 0.01 * before.all);
  // A desk without steps lies where it lay.
  EXPECT_NEAR(estimate_frame(some, rig, view)->desk.offset, rig.height_m, 1e-5);
  // Holes shift no other pixels: a trial with some shows the same ones.
  std::set<float> known;
  for (const SensedPoint& sensed : some) known.insert(sensed.point.x());
  for (const SensedPoint& sensed : thinned(50)) EXPECT_TRUE(known.contains(sensed.point.x()));
  // Clouds that were thinned before keep what they have.
  const std::vector<SensedPoint> few = desk_of_rows(rig, 2);
  EXPECT_EQ(with_desk_thinned({}, few, rig, view).size(), few.size());
}

}  // namespace
}  // namespace fathom
