#include "detector/cluster.h"

#include <gtest/gtest.h>

#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>

#include <algorithm>

#include "core/rng.h"

namespace fathom {
namespace {

/// 1 cm steps along a line.
Points row_of(int count, float x, float y) {
  Points points;
  for (int i = 0; i < count; ++i) points.emplace_back(x + 0.01f * static_cast<float>(i), y, 0.0f);
  return points;
}

Points together(Points a, const Points& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(Clusters, GapsUpToTheDistanceConnect) {
  const Points near = together(row_of(30, 0.0f, 0.0f), row_of(20, 0.0f, 0.039f));
  EXPECT_EQ(euclidean_clusters(near, 0.040, 1).size(), 1u);
  const Points far = together(row_of(30, 0.0f, 0.0f), row_of(20, 0.0f, 0.041f));
  EXPECT_EQ(euclidean_clusters(far, 0.040, 1).size(), 2u);
}

TEST(Clusters, EveryPointIsInExactlyOneTheLargestFirst) {
  const Points points = together(row_of(20, 0.0f, 0.0f), row_of(30, 0.0f, 0.5f));
  const std::vector<Points> segments = euclidean_clusters(points, 0.040, 1);
  ASSERT_EQ(segments.size(), 2u);
  EXPECT_EQ(segments[0].size(), 30u);
  EXPECT_EQ(segments[1].size(), 20u);
}

TEST(Clusters, SmallOnesAreDropped) {
  const Points points = together(row_of(20, 0.0f, 0.0f), row_of(30, 0.0f, 0.5f));
  EXPECT_EQ(euclidean_clusters(points, 0.040, 21).size(), 1u);
  EXPECT_TRUE(euclidean_clusters(points, 0.040, 31).empty());
  EXPECT_TRUE(euclidean_clusters({}, 0.040, 1).empty());
}

TEST(Clusters, DoNotDependOnTheOrderOfThePoints) {
  Points points = together(row_of(20, 0.0f, 0.0f), row_of(30, 0.0f, 0.5f));
  const auto sizes = [](const std::vector<Points>& segments) {
    std::vector<std::size_t> result;
    for (const Points& segment : segments) result.push_back(segment.size());
    return result;
  };
  const auto before = sizes(euclidean_clusters(points, 0.040, 1));
  std::reverse(points.begin(), points.end());
  EXPECT_EQ(sizes(euclidean_clusters(points, 0.040, 1)), before);
}

TEST(Clusters, AreThoseOfThePointCloudLibrary) {
  Rng rng(1);
  Points points;
  for (int i = 0; i < 4000; ++i) {  // as dense as makes clusters of all sizes
    const auto coordinate = [&] { return static_cast<float>(0.9 * rng.uniform() - 0.4); };
    points.emplace_back(coordinate(), coordinate(), coordinate());
  }
  const auto cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (const Eigen::Vector3f& p : points) cloud->push_back({p.x(), p.y(), p.z()});
  const auto tree = std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>();
  tree->setInputCloud(cloud);
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setClusterTolerance(0.040);
  extraction.setSearchMethod(tree);
  extraction.setInputCloud(cloud);
  std::vector<pcl::PointIndices> groups;
  extraction.extract(groups);
  std::vector<std::size_t> expected, sizes;
  for (const pcl::PointIndices& group : groups) expected.push_back(group.indices.size());
  for (const Points& group : euclidean_clusters(points, 0.040, 1)) sizes.push_back(group.size());
  std::sort(expected.rbegin(), expected.rend());
  EXPECT_EQ(sizes, expected);
  EXPECT_GT(sizes.size(), 100u);
  EXPECT_GT(sizes.front(), 20u);
}

}  // namespace
}  // namespace fathom
