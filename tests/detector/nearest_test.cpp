#include "detector/nearest.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/rng.h"

namespace fathom {
namespace {

TEST(NearestPoints, AreThoseThatLookingAtAllFinds) {
  Rng rng(1);
  const auto any = [&]() -> Eigen::Vector3f {
    return Eigen::Vector3d(rng.uniform(), rng.uniform(), 0.1 * rng.uniform()).cast<float>();
  };
  for (const int count : {1, 2, 9, 1000}) {
    Points points;
    for (int i = 0; i < count; ++i) points.push_back(any());
    points.push_back(points.front());  // twice the same
    const NearestPoints tree(points);
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector3f to = 2.0f * any();
      const auto distance = [&](const Eigen::Vector3f& p) { return (p - to).squaredNorm(); };
      float least = distance(points[0]);
      for (const Eigen::Vector3f& p : points) least = std::min(least, distance(p));
      EXPECT_EQ(distance(tree.point(tree.nearest(to))), least);
      EXPECT_EQ(distance(tree.point(tree.nearest(to, i % count))), least);
    }
  }
}

}  // namespace
}  // namespace fathom
