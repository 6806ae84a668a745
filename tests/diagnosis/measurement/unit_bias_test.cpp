// A unit's bias, learned from a campaign's own desks and taken off its clouds.
#include "diagnosis/measurement/unit_bias.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/rng.h"
#include "tests/diagnosis/measurement/tilted_desk.h"

namespace fathom {
namespace unit_bias_test {

const LaboratoryRig kRig = laboratory();

/// A bias [px] in the frame of the reference, of the size and reach that units have.
double bias_px(double column_px, double row_px) {
  return 0.1 * std::sin(column_px / 75.0 + 0.5) * std::cos(row_px / 75.0);
}

/// Every second pixel of a desk as such a unit reads it.
std::vector<SensedPoint> desk(double noise_px, std::uint64_t seed) {
  const double at_reference = kRig.focal_px * kRig.baseline_m / kReferenceDistance_m;
  Rng rng(seed);
  return desk_points(kRig, 2.0, [&](double column, double row, double true_px) {
    return bias_px(column - (true_px - at_reference), row) + noise_px * rng.normal();
  });
}

double residual_mm(const FrameEstimates& estimates) {
  double squares = 0.0;
  for (const RegionEstimate& third : estimates.desk_residual) squares += third.mean * third.mean / 9.0;
  return mm_from_metres(std::sqrt(squares));
}

UnitBias learned(double noise_px) {
  Desks desks;
  for (std::uint64_t cloud = 0; cloud < 4; ++cloud) {
    const std::vector<SensedPoint> points = desk(noise_px, cloud);
    desks[{}].emplace_back().add(points, estimate_frame(points, kRig, {})->desk, kRig, {});
  }
  return UnitBias(desks);
}

TEST(UnitBias, LearnedFromDesksFlattensThem) {
  const UnitBias unit = learned(0.1);
  std::vector<SensedPoint> points = desk(0.1, 99);
  const double before = residual_mm(*estimate_frame(points, kRig, {}));
  take_off(as_bias(unit.field()), kRig, points);
  const double after = residual_mm(*estimate_frame(points, kRig, {}));
  EXPECT_GT(before, 0.2);
  EXPECT_LT(after, 0.1 * before);
}

/// The error of a lens whose k1 is 0.05: 1.5 px in the corners, three times what things on a desk may be off by.
double bent_px(double column, double row) {
  const double x = (column - 320.0) / kRig.focal_px, y = (row - 240.0) / kRig.focal_px;
  return 1.3 * (3.0 * x * x + y * y);
}

BiasView view_of(const std::vector<SensedPoint>& points) {
  DeskCells cells;
  cells.add(points, estimate_frame(points, kRig, {})->desk, kRig, {});
  return cells.view();
}

TEST(UnitBias, IsLearnedUpToTheCornersThatALensBends) {
  const BiasView view = view_of(desk_points(kRig, 2.0, [&](double c, double r, double) { return bent_px(c, r); }));
  EXPECT_EQ(view.cells.size(), 40u * 30u);
}

TEST(UnitBias, IsNotLearnedFromABoardOnTheDesk) {
  constexpr double kBoard_px = 0.7;  // 7 mm high
  const Eigen::AlignedBox2d board(Eigen::Vector2d(400.0, 240.0), Eigen::Vector2d(560.0, 400.0));
  const BiasView view = view_of(desk_points(kRig, 2.0, [&](double c, double r, double) {
    return bent_px(c, r) + (board.contains(Eigen::Vector2d(c, r)) ? kBoard_px : 0.0);
  }));
  EXPECT_EQ(view.cells.size(), 40u * 30u - 10u * 10u);
  for (const BiasCell& cell : view.cells) EXPECT_FALSE(board.contains(cell.pixel_px()));
}

/// What lies in a part of the image.
std::vector<SensedPoint> cut_out(std::vector<SensedPoint> points, const Eigen::AlignedBox2d& part_px) {
  std::erase_if(points, [&](const SensedPoint& p) { return !part_px.contains(bias_point(p.point, kRig).pixel_px); });
  return points;
}

/// A desk that bends more and more towards the image's border, as behind a lens whose distortion is not known.
std::vector<SensedPoint> bent_desk() {
  return desk_points(kRig, 2.0, [](double column, double row, double) {
    return 0.2 * std::hypot(column / 320.0 - 1.0, row / 240.0 - 1.0) *
           std::hypot(column / 320.0 - 1.0, row / 240.0 - 1.0);
  });
}

/// The height of the sensor above what it reads of a bent desk in that part of the image.
double height_mm(const Eigen::AlignedBox2d& part_px, const UnitBias* unit) {
  std::vector<SensedPoint> points = cut_out(bent_desk(), part_px);
  if (unit) take_off(as_bias(unit->field()), kRig, points);
  return mm_from_metres(estimate_frame(points, kRig, {})->desk.offset);
}

TEST(UnitBias, OfCloudsThatAreCutOutIsFreeOfTheLeanOfTheirPlanes) {
  const auto part = [](double left, double top) {
    return Eigen::AlignedBox2d(Eigen::Vector2d(left, top), Eigen::Vector2d(left + 360.0, top + 300.0));
  };
  const std::vector<Eigen::AlignedBox2d> parts{part(0.0, 0.0), part(280.0, 0.0), part(0.0, 180.0), part(280.0, 180.0)};
  Desks desks;
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (int placement = 0; placement < 2; ++placement) {
      const std::vector<SensedPoint> points = cut_out(bent_desk(), parts[i]);
      desks[{.lateral_m = static_cast<double>(i)}].emplace_back().add(points, estimate_frame(points, kRig, {})->desk,
                                                                      kRig, {});
    }
  const UnitBias unit(desks);
  const double apart_mm = height_mm(parts[0], nullptr) - height_mm(parts[2], nullptr);
  EXPECT_GT(std::abs(apart_mm), 1.0);
  EXPECT_LT(std::abs(height_mm(parts[0], &unit) - height_mm(parts[2], &unit)), 0.2 * std::abs(apart_mm));
}

TEST(FrameEstimates, OfAPartOfTheImageAreThoseOfWhatLiesInIt) {
  const Eigen::AlignedBox2d part(Eigen::Vector2d(100.0, 150.0), Eigen::Vector2d(400.0, 480.0));
  const std::vector<SensedPoint> whole = bent_desk();
  FrameView view;
  view.desk_px = part;
  const Plane cut = estimate_frame(cut_out(whole, part), kRig, {})->desk,
              seen = estimate_frame(whole, kRig, view)->desk;
  EXPECT_NEAR(cut.offset, seen.offset, 1e-9);
  EXPECT_LT((cut.normal - seen.normal).norm(), 1e-9);
  EXPECT_GT(std::abs(cut.offset - estimate_frame(whole, kRig, {})->desk.offset),
            1e-4);  // elsewhere the desk bends away
}

TEST(UnitBias, LeavesWhatTheDeviceGaveKnown) {
  std::vector<SensedPoint> points = desk(0.0, 1);
  const std::vector<SensedPoint> given = points;
  take_off(as_bias(learned(0.0).field()), kRig, points);
  for (std::size_t i = 0; i < points.size(); i += 1000) {
    EXPECT_EQ(points[i].device_z, given[i].point.z());
    // Along the same line of sight.
    EXPECT_NEAR(points[i].point.x() / points[i].point.z(), given[i].point.x() / given[i].point.z(), 1e-6);
  }
}

TEST(UnitBias, WhatIsLearnedFromAModelIsLinear) {
  const UnitBias unit = learned(0.05);
  const auto error_at = [](double factor) {
    return [factor](const BiasCell& cell) -> std::optional<double> {
      return factor * bias_px(cell.column_px, cell.row_px);
    };
  };
  const BiasPoint middle{.pixel_px = {330.0, 250.0}, .nearer_px = 20.0};
  const double once = unit.learn({{0, error_at(1.0)}}).at(middle), twice = unit.learn({{0, error_at(2.0)}}).at(middle);
  EXPECT_NE(once, 0.0);
  EXPECT_NEAR(twice, 2.0 * once, 1e-6);
}

TEST(UnitBias, WhereNoDeskWasSeenItsErrorIsLargerThanWhereItWas) {
  Desks desks;
  std::vector<SensedPoint> points = desk(0.1, 5);
  std::erase_if(points, [](const SensedPoint& p) {
    const Eigen::Vector2d pixel = bias_point(p.point, kRig).pixel_px;
    return (pixel - Eigen::Vector2d(320.0, 240.0)).norm() < 120.0;
  });
  desks[{}].emplace_back().add(points, estimate_frame(points, kRig, {})->desk, kRig, {});
  const UnitBias unit(desks);
  const double hidden = unit.sigma({.pixel_px = {320.0, 240.0}, .nearer_px = 0.0}),
               seen = unit.sigma({.pixel_px = {500.0, 100.0}, .nearer_px = 0.0});
  EXPECT_GT(hidden, 3.0 * seen);
  EXPECT_LT(hidden, 0.15);  // no more than was thought beforehand
}

TEST(UnitBias, ItsPlanesTurnTheDeskAsFarAsAFieldOfThatReachDoes) {
  // A field of 0.1 px over 70 px holds some ten independent parts: its mean is uncertain by about 0.03 px.
  const std::vector<Bias> modes = learned(0.1).error_modes(0, {});
  ASSERT_EQ(modes.size(), 3U);
  double variance = 0.0;
  for (const Bias& mode : modes) {
    const double in_the_middle = mode({.pixel_px = {320.0, 240.0}, .nearer_px = 0.0});
    variance += in_the_middle * in_the_middle;
  }
  EXPECT_NEAR(std::sqrt(variance), 0.03, 0.015);
}

}  // namespace unit_bias_test
}  // namespace fathom
