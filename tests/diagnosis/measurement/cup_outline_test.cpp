// The circle that a cup's walls lie on, from where the sensor sees them.
#include "diagnosis/measurement/cup_outline.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace fathom {
namespace {

constexpr double kNear = -0.5 * std::numbers::pi, kFar = 0.5 * std::numbers::pi;  // directions from the axis

/// The paper's cup, 200 mm in front of a sensor.
struct Outline : testing::Test {
  const LaboratoryRig rig{};
  OutlineFit fit{rig, {0.0, 0.200}, 0.0};

  /// Points 3° apart, 70° to either side of `towards`, on a circle of `radius` about `axis`, from `low` to `high`.
  void add_wall(double towards, double radius, const Eigen::Vector2d& axis, double low, double high) {
    for (int degrees = -69; degrees <= 69; degrees += 3)
      for (double height = low; height < high; height += 0.005) {
        const double angle = towards + degrees * std::numbers::pi / 180.0;
        fit.add(axis + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)), height, 1.0);
      }
  }
};

TEST_F(Outline, OfACupThatIsWiderAndBesideItsPlace) {
  const Eigen::Vector2d off(0.003, -0.002);
  add_wall(kNear, rig.cup.widest() + 0.001, off, 0.015, 0.075);
  add_wall(kFar, rig.cup.narrowest() + 0.001, off, 0.055, 0.075);
  const auto outline = fit.solve();
  ASSERT_TRUE(outline);
  EXPECT_NEAR(outline->off.x(), off.x(), 1e-5);  // of the third step of Gauss and Newton
  EXPECT_NEAR(outline->off.y(), off.y(), 1e-5);
  EXPECT_NEAR(outline->wider, 0.001, 1e-5);
}

/// Its walls are as wide as at the height where they are seen.
TEST_F(Outline, OfACupWhoseWallsLean) {
  LaboratoryRig tapered;
  tapered.height_m = 0.650;
  tapered.cup = {{{0.0, 0.004}, {0.026, 0.004}, {0.038, 0.090}}, {{0.0, 0.0}, {0.027, 0.0}, {0.039, 0.090}}};
  fit = OutlineFit(tapered, {0.0, 0.200}, 0.0);
  const Eigen::Vector2d off(0.003, -0.002);
  for (double low = 0.015; low < 0.075; low += 0.005) {
    add_wall(kNear, tapered.cup.outer_radius(low), off, low, low + 0.001);
    add_wall(kFar, tapered.cup.inner_radius(low), off, low, low + 0.001);
  }
  const auto outline = fit.solve();
  ASSERT_TRUE(outline);
  EXPECT_LT((outline->off - off).norm(), 1e-5);
  EXPECT_NEAR(outline->wider, 0.0, 1e-5);
}

/// Points that are off by 0.3 mm, each for itself, move the fit by that over the root of its pixels.
TEST_F(Outline, KnowsAsMuchAsAMeanOfItsPixels) {
  constexpr double kError = 0.3e-3;
  constexpr int kDraws = 400;  // variances are found to 7 %; the tolerance is four times that
  std::mt19937_64 generator(1);
  std::normal_distribution<double> error(0.0, kError);
  double least = 1e9, most = 0.0;
  for (const int half_arc_deg : {69, 42}) {
    Eigen::Vector3d squares = Eigen::Vector3d::Zero(), pixels;
    for (int draw = 0; draw < kDraws; ++draw) {
      fit = OutlineFit(rig, {0.0, 0.200}, 0.0);
      for (int degrees = -half_arc_deg; degrees <= half_arc_deg; degrees += 3)
        for (double height = 0.055; height < 0.075; height += 0.005)
          for (const bool is_far : {false, true}) {
            const double angle = (is_far ? kFar : kNear) + degrees * std::numbers::pi / 180.0;
            const double radius = (is_far ? rig.cup.narrowest() : rig.cup.widest()) + error(generator);
            fit.add(radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)), height, 1.0);
          }
      const auto outline = fit.solve();
      ASSERT_TRUE(outline);
      squares += Eigen::Vector3d(outline->off.x(), outline->off.y(), outline->wider).cwiseAbs2();
      pixels = outline->pixels;
    }
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(squares[k] / kDraws * pixels[k] / (kError * kError), 1.0, 0.28) << k;
    least = std::min(least, pixels.x());
    most = std::max(most, pixels.x());
  }
  EXPECT_GT(most, 3.0 * least) << "short arcs tell little of what is across them";
}

/// From high above the near side of such a cup shows its inner wall, which is no outer one.
TEST_F(Outline, TakesNoInnerWallForTheOuterOne) {
  LaboratoryRig tapered;
  tapered.cup = {{{0.0, 0.004}, {0.020, 0.004}, {0.045, 0.090}}, {{0.0, 0.0}, {0.023, 0.0}, {0.048, 0.090}}};
  for (const double height : {0.300, 2.000}) {
    tapered.height_m = height;
    fit = OutlineFit(tapered, {0.0, 0.300}, 0.0);
    for (double low = 0.015; low < 0.075; low += 0.005) {
      add_wall(kNear, tapered.cup.inner_radius(low), {0.0, 0.0}, low, low + 0.001);
      add_wall(kFar, tapered.cup.inner_radius(low), {0.0, 0.0}, low, low + 0.001);
    }
    const auto outline = fit.solve();
    if (height > 1.0)
      EXPECT_FALSE(outline) << outline->wider;
    else
      EXPECT_TRUE(outline) << "there the near side can show but the outer wall";
  }
}

/// Wherever within its bounds an effect has put a cup, an opaque liquid near the rim being in it.
TEST_F(Outline, OfACupFarBesideItsPlace) {
  for (int eighth = 0; eighth < 8; ++eighth)
    for (const double far : {0.012, 0.020, 0.030}) {
      const Eigen::Vector2d off = Eigen::Rotation2Dd(0.25 * std::numbers::pi * eighth) * Eigen::Vector2d(far, 0.0);
      fit = OutlineFit(rig, {0.0, 0.200}, 0.0);
      add_wall(kNear, rig.cup.widest(), off, 0.015, 0.075);
      add_wall(kFar, rig.cup.narrowest(), off, 0.055, 0.075);
      for (double radius = 0.002; radius < rig.cup.narrowest(); radius += 0.002)
        for (const double towards : {kNear, kFar}) add_wall(towards, radius, off, 0.050, 0.051);
      const auto outline = fit.solve();
      ASSERT_TRUE(outline) << off.transpose();
      EXPECT_LT((outline->off - off).norm(), 0.001) << off.transpose();  // the liquid's edge draws the outer wall
      EXPECT_LT(std::abs(outline->wider), 0.001) << off.transpose();
    }
}

/// A surface's edge is as near the wall as the wall itself, and where noise or light lets points of walls fall out
/// there is more of it.
TEST_F(Outline, HoldsNothingOfALiquidNearTheRim) {
  for (const double fill : {0.050, 0.060}) {
    const double level = rig.cup.bottom() + fill;
    fit = OutlineFit(rig, {0.0, 0.200}, fill);
    add_wall(kNear, rig.cup.widest(), {0.0, 0.0}, 0.015, 0.075);
    for (const double above : {0.002, 0.004}) add_wall(kFar, rig.cup.narrowest(), {0.0, 0.0}, level + above, 0.080);
    for (double radius = 0.002; radius < rig.cup.narrowest(); radius += 0.001)
      add_wall(kFar, radius, {0.0, 0.0}, level, level + 0.001);
    const auto outline = fit.solve();
    ASSERT_TRUE(outline) << fill;
    EXPECT_NEAR(outline->wider, 0.0, 1e-5) << fill;
    EXPECT_LT(outline->off.norm(), 1e-5) << fill;
  }
}

/// The notes may say less than was poured.
TEST_F(Outline, HoldsNothingOfALiquidThatStandsHigherThanWritten) {
  for (const double higher : {0.003, 0.006, 0.009}) {
    const double level = rig.cup.bottom() + 0.052 + higher;
    fit = OutlineFit(rig, {0.0, 0.200}, 0.052);
    add_wall(kNear, rig.cup.widest(), {0.0, 0.0}, 0.015, 0.075);
    for (const double above : {0.002, 0.004}) add_wall(kFar, rig.cup.narrowest(), {0.0, 0.0}, level + above, 0.080);
    for (double radius = 0.002; radius < rig.cup.narrowest(); radius += 0.001)
      for (const double towards : {kNear, kFar}) add_wall(towards, radius, {0.0, 0.0}, level, level + 0.001);
    const auto outline = fit.solve();
    ASSERT_TRUE(outline) << higher;
    EXPECT_NEAR(outline->wider, 0.0, 1e-5) << higher;
    EXPECT_LT(outline->off.norm(), 1e-5) << higher;
  }
}

/// A radius and a place that belong to each other fit one side alike.
TEST_F(Outline, OfOneSideIsNone) {
  add_wall(kFar, rig.cup.narrowest(), {0.0, 0.0}, 0.055, 0.075);
  EXPECT_FALSE(fit.solve());
}

/// Nor do some points of a liquid make the other side, which windows put where the wall of a smaller cup might be.
TEST_F(Outline, IsNotThatOfALiquid) {
  add_wall(kFar, rig.cup.narrowest(), {0.0, 0.0}, 0.055, 0.075);
  add_wall(kNear, 0.034, {0.0, 0.0}, 0.024, 0.025);
  EXPECT_FALSE(fit.solve());
}

/// Looked at steeply, a leaning outer wall is too narrow for a block to match, and the surface behind it is all there
/// is.
TEST_F(Outline, OfWhichTheOuterWallIsNotSeenIsNone) {
  LaboratoryRig tapered;
  tapered.height_m = 0.650;
  tapered.cup = {{{0.0, 0.004}, {0.026, 0.004}, {0.038, 0.090}}, {{0.0, 0.0}, {0.027, 0.0}, {0.039, 0.090}}};
  const double written = 0.042;
  for (const double fill : {0.85 * written, written, 1.15 * written}) {
    fit = OutlineFit(tapered, {0.0, 0.200}, written);
    for (double low = 0.052; low < 0.080; low += 0.002)
      add_wall(kFar, tapered.cup.inner_radius(low), {0.0, 0.0}, low, low + 0.001);
    for (double radius = 0.002; radius < 0.028; radius += 0.001)
      for (const double towards : {kNear, kFar}) add_wall(towards, radius, {0.0, 0.0}, 0.004 + fill, 0.005 + fill);
    EXPECT_FALSE(fit.solve()) << fill;
  }
}

}  // namespace
}  // namespace fathom
