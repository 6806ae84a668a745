#include "detector/cluster.h"

#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>

#include "detector/pcl_points.h"

namespace fathom {

std::vector<Points> euclidean_clusters(const Points& points, double distance_m, int points_min) {
  if (points.empty()) return {};  // PCL's search tree refuses an empty cloud
  const auto cloud = pcl_cloud(points);
  const auto tree = std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>(false);  // unsorted neighbours: faster
  tree->setInputCloud(cloud);
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setClusterTolerance(distance_m);
  extraction.setMinClusterSize(points_min);
  extraction.setSearchMethod(tree);
  extraction.setInputCloud(cloud);
  std::vector<pcl::PointIndices> groups;
  extraction.extract(groups);

  std::vector<Points> segments;
  for (const pcl::PointIndices& group : groups) {
    Points& segment = segments.emplace_back();
    segment.reserve(group.indices.size());
    for (const int i : group.indices) segment.push_back(points[i]);
  }
  return segments;
}

}  // namespace fathom
