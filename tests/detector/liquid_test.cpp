#include "detector/liquid.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fathom {
namespace {

const Circle kCircle{{0.0, 0.4}, 0.040, 0.0};

/// A level disc of points, 1 mm apart.
Points disc(double radius, double height) {
  Points points;
  for (int x = -60; x <= 60; ++x)
    for (int y = -60; y <= 60; ++y)
      if (std::hypot(x, y) < 1000.0 * radius)
        points.push_back(Eigen::Vector3d(0.001 * x, 0.4 + 0.001 * y, height).cast<float>());
  return points;
}

TEST(Interior, TheHeightOfALevelSurfaceIsItsHeight) {
  const auto height = interior_height(disc(0.045, 0.0123), kCircle, {});
  ASSERT_TRUE(height);
  EXPECT_NEAR(height->mean_m, 0.0123, 1e-8);  // single-precision points
  EXPECT_LT(height->sd_m, 1e-8);
  EXPECT_NEAR(height->points, M_PI * 30.0 * 30.0, 60.0);  // radius 40 − 10 mm; the count of a disc's lattice points
}

TEST(Interior, TheWallDoesNotCount) {
  Points scene = disc(0.0295, 0.010);
  const auto before = interior_height(scene, kCircle, {});
  for (int degree = 0; degree < 360; ++degree)
    for (int mm = 0; mm < 80; ++mm)
      scene.push_back(Eigen::Vector3d(0.0305 * std::cos(degree * M_PI / 180),
                                      0.4 + 0.0305 * std::sin(degree * M_PI / 180), 0.001 * mm)
                          .cast<float>());
  const auto after = interior_height(scene, kCircle, {});
  ASSERT_TRUE(before && after);
  EXPECT_EQ(after->points, before->points);
  EXPECT_EQ(after->mean_m, before->mean_m);
}

TEST(Interior, SpreadAndErrorAreThoseOfThePoints) {
  Points scene = disc(0.030, 0.010);
  for (std::size_t i = 0; i < scene.size(); ++i) scene[i].z() += (i % 2 == 0 ? 0.001f : -0.001f);
  const auto height = interior_height(scene, kCircle, {});
  ASSERT_TRUE(height);
  EXPECT_NEAR(height->sd_m, 0.001, 2e-6);  // √(n/(n−1)) of some 2800 points, and an odd one
  EXPECT_NEAR(height->standard_error_m(), height->sd_m / std::sqrt(height->points), 1e-12);
}

TEST(Interior, NothingIsSeenWhereThereAreTooFewPoints) {
  Points scene = disc(0.0016, 0.010);  // 9 points
  EXPECT_FALSE(interior_height(scene, kCircle, {}));
  scene.emplace_back(0.003f, 0.4f, 0.010f);
  EXPECT_TRUE(interior_height(scene, kCircle, {}));
  EXPECT_FALSE(interior_height({}, kCircle, {}));
  EXPECT_FALSE(interior_height(disc(0.03, 0.01), {{0.0, 0.4}, 0.010, 0.0}, {}));  // no radius left
}

TEST(Liquid, IsWhatStandsAboveTheThreshold) {
  const auto decided = [](double height) {
    return decide_liquid(interior_height(disc(0.04, height), kCircle, {}), 0.009);
  };
  EXPECT_EQ(decided(0.0070), Liquid::kNo);
  EXPECT_EQ(decided(0.0089), Liquid::kNo);
  EXPECT_EQ(decided(0.0091), Liquid::kYes);
  EXPECT_EQ(decided(0.0370), Liquid::kYes);
  EXPECT_EQ(decide_liquid(std::nullopt, 0.009), Liquid::kUnknown);
}

}  // namespace
}  // namespace fathom
