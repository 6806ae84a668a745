// Our point feature histograms beside PCL's.
#include "detector/fpfh.h"

#include <gtest/gtest.h>
#include <pcl/features/fpfh.h>
#include <pcl/search/kdtree.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/rng.h"

namespace fathom {
namespace fpfh_test {

TEST(Fpfh, AreThoseOfPcl) {
  constexpr double kRadius = 0.03;
  Rng rng(1);
  Points points, normals;
  const auto cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  const auto directions = std::make_shared<pcl::PointCloud<pcl::Normal>>();
  for (int i = 0; i < 800; ++i) {  // part of a cup's wall, its normals uneven as measured ones are
    const double angle = 2.5 * rng.uniform(), height = 0.1 * rng.uniform();
    const Eigen::Vector3d out(std::cos(angle), std::sin(angle), 0.0);
    const Eigen::Vector3d uneven(rng.normal(), rng.normal(), rng.normal());
    points.push_back((0.04 * out + height * Eigen::Vector3d::UnitZ() + 0.001 * uneven).cast<float>());
    normals.push_back((out + 0.1 * uneven).normalized().cast<float>());
    const Eigen::Vector3f &p = points.back(), &n = normals.back();
    cloud->emplace_back(p.x(), p.y(), p.z());
    directions->emplace_back(n.x(), n.y(), n.z());
  }
  const auto tree = std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>();
  pcl::FPFHEstimation<pcl::PointXYZ, pcl::Normal, pcl::FPFHSignature33> theirs;
  theirs.setInputCloud(cloud);
  theirs.setInputNormals(directions);
  theirs.setSearchMethod(tree);
  theirs.setRadiusSearch(kRadius);
  pcl::PointCloud<pcl::FPFHSignature33> expected;
  theirs.compute(expected);

  std::vector<std::vector<Neighbour>> neighbours(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::vector<int> indices;
    std::vector<float> distances;
    tree->radiusSearch((*cloud)[i], kRadius, indices, distances);
    for (std::size_t k = 0; k < indices.size(); ++k) neighbours[i].push_back({indices[k], distances[k]});
  }
  const std::vector<Fpfh> ours = fast_point_feature_histograms(points, normals, neighbours);
  ASSERT_EQ(ours.size(), expected.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < ours.size(); ++i)
    for (std::size_t bin = 0; bin < ours[i].size(); ++bin)
      worst = std::max<double>(worst, std::abs(ours[i][bin] - expected[i].histogram[bin]));
  EXPECT_LT(worst, 0.5);  // percent: an angle at a bin's border may be rounded into the next bin
}

}  // namespace fpfh_test
}  // namespace fathom
