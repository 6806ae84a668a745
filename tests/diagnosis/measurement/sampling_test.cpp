// Points of clouds that were thinned in one part of the image and not in another.
#include "diagnosis/measurement/cloud_sampling.h"

#include <gtest/gtest.h>

#include "diagnosis/measurement/sensed_frame.h"

namespace fathom {
namespace sampling_test {

constexpr double kFocal_px = 570.0;
constexpr int kLeft = 280, kRight = 360, kTop = 200, kBottom = 280;  ///< [px] of what a cup covers

/// A wall 1 m ahead: every so many pixels in the middle of the image and around it.
Points wall(int every_inside, int every_outside) {
  Points points;
  for (int row = 0; row < 480; ++row)
    for (int column = 0; column < 640; ++column) {
      const bool is_inside = column >= kLeft && column < kRight && row >= kTop && row < kBottom;
      const int every = is_inside ? every_inside : every_outside;
      if (row % every == 0 && column % every == 0)
        points.push_back((Eigen::Vector3d(column - 319.5, row - 239.5, kFocal_px) / kFocal_px).cast<float>());
    }
  return points;
}

TEST(Sampling, PointsStandForTheAreaAroundThem) {
  for (const auto& [inside, outside] : {std::pair{1, 1}, {2, 16}, {1, 8}}) {
    std::vector<SensedPoint> points;
    for (const Eigen::Vector3f& point : wall(inside, outside)) points.push_back({point, 0.0f});
    weigh_by_sampling(points, kFocal_px);
    double pixels = 0.0;
    for (const SensedPoint& sensed : points) pixels += sensed.weight;
    EXPECT_NEAR(pixels / (640.0 * 480.0), 1.0, 0.03) << inside << " " << outside;  // of the border between the two
  }
}

/// An organised cloud need not have every column and row of the image. (Thinned in one direction alone it counts for
/// too little.)
TEST(Sampling, PixelsOfThinnedImagesStandForMore) {
  for (const auto& [across, down] : {std::pair{2, 2}, {3, 3}}) {
    Cloud cloud;
    cloud.width = 640 / across, cloud.height = 480 / down;
    for (int row = 0; row < cloud.height; ++row)
      for (int column = 0; column < cloud.width; ++column)
        cloud.points.push_back(
            (Eigen::Vector3d(column * across - 319.5, row * down - 239.5, kFocal_px) / kFocal_px).cast<float>());
    double pixels = 0.0;
    for (const SensedPoint& sensed : sensed_points(cloud, LaboratoryRig{})) pixels += sensed.weight;
    EXPECT_NEAR(pixels / (640.0 * 480.0), 1.0, 0.03) << across << " " << down;
  }
}

TEST(Sampling, ThinnedEvenlyIsAsTheMostOfTheImage) {
  for (const int every : {4, 8, 16}) {
    const auto even = static_cast<double>(wall(every, every).size());
    EXPECT_NEAR(static_cast<double>(thinned_evenly(wall(2, every), kFocal_px).size()) / even, 1.0, 0.03) << every;
  }
}

TEST(Sampling, WhatIsEvenStaysWhole) {
  for (const int every : {1, 3, 8}) {
    const Points points = wall(every, every);
    EXPECT_EQ(thinned_evenly(points, kFocal_px).size(), points.size()) << every;
  }
}

TEST(Sampling, KnowsPointsThatNoImageHas) {
  Points points = wall(2, 8);
  for (const float z : {0.0f, -1.0f, 1e-30f}) points.emplace_back(1.0f, 0.0f, z);
  EXPECT_LE(thinned_evenly(points, kFocal_px).size(), points.size());
}

}  // namespace sampling_test
}  // namespace fathom
