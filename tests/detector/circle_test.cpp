#include "detector/circle.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/rng.h"

namespace fathom {
namespace {

std::vector<Eigen::Vector2d> arc(const Eigen::Vector2d& center, double radius, double from_rad, double to_rad,
                                 int count) {
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < count; ++i) {
    const double angle = from_rad + (to_rad - from_rad) * i / (count - 1);
    points.push_back(center + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return points;
}

TEST(Circle, IsExactOnExactArcsOfAnyLengthAndPlace) {
  for (const double length : {0.2, 1.0, 3.0, 2.0 * std::numbers::pi}) {
    const Eigen::Vector2d center(0.3, -1.1);
    const auto circle = fit_circle(arc(center, 0.043, 0.7, 0.7 + length, 50));
    ASSERT_TRUE(circle);
    // The normal equations' conditioning grows as the arc's length to the minus fourth: 1e-16 / 0.2^4 with room.
    EXPECT_NEAR(circle->radius_m, 0.043, 1e-11);
    EXPECT_LT((circle->center - center).norm(), 1e-11);
    EXPECT_LT(circle->rms_m, 1e-12);
  }
}

TEST(Circle, RmsIsTheRadialScatter) {
  Rng rng(7);
  std::vector<Eigen::Vector2d> points = arc({0.0, 0.4}, 0.04, 0.0, 6.2, 4000);
  for (Eigen::Vector2d& point : points) {
    const Eigen::Vector2d outward = (point - Eigen::Vector2d(0.0, 0.4)).normalized();
    point += 0.001 * rng.normal() * outward;
  }
  const auto circle = fit_circle(points);
  ASSERT_TRUE(circle);
  EXPECT_NEAR(circle->rms_m, 0.001, 5e-5);    // 4.5 standard errors, σ/√(2n) = 1.1e-5
  EXPECT_NEAR(circle->radius_m, 0.04, 1e-4);  // 6 standard errors of 1.6e-5 and Kåsa's bias of σ²/r = 2.5e-5
}

TEST(Circle, TurningAndShiftingThePointsTurnsAndShiftsTheCircle) {
  std::vector<Eigen::Vector2d> points = arc({0.01, 0.02}, 0.05, 0.0, 2.0, 40);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i].x() += 0.001 * static_cast<double>(i % 3);  // no exact circle
  const auto before = fit_circle(points);
  const Eigen::Rotation2Dd turn(1.234);
  const Eigen::Vector2d shift(0.7, -0.4);
  for (Eigen::Vector2d& point : points) point = turn * point + shift;
  const auto after = fit_circle(points);
  ASSERT_TRUE(before && after);
  EXPECT_NEAR(after->radius_m, before->radius_m, 1e-12);  // rounding
  EXPECT_LT((after->center - (turn * before->center + shift)).norm(), 1e-12);
}

TEST(Circle, NeedsThreePointsThatAreNotOnALine) {
  EXPECT_FALSE(fit_circle({}));
  EXPECT_FALSE(fit_circle({{0.0, 0.0}, {1.0, 0.0}}));
  EXPECT_FALSE(fit_circle({{0.1, 0.1}, {0.1, 0.1}, {0.1, 0.1}}));
  EXPECT_FALSE(fit_circle({{0.0, 0.0}, {0.1, 0.2}, {0.2, 0.4}, {0.3, 0.6}}));
  EXPECT_TRUE(fit_circle({{0.0, 0.0}, {0.1, 0.0}, {0.0, 0.1}}));
}

}  // namespace
}  // namespace fathom
