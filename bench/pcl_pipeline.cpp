#include "bench/pcl_pipeline.h"

#include <pcl/common/centroid.h>
#include <pcl/common/transforms.h>
#include <pcl/filters/extract_indices.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/registration/icp.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>
#include <pcl/segmentation/sac_segmentation.h>

#include <algorithm>
#include <limits>

namespace fathom {
namespace {

using PointCloud = pcl::PointCloud<pcl::PointXYZ>;

PointCloud::Ptr pcl_cloud_of(const Points& points) {
  auto cloud = std::make_shared<PointCloud>();
  for (const Eigen::Vector3f& point : points) cloud->push_back({point.x(), point.y(), point.z()});
  return cloud;
}

PointCloud::Ptr without_largest_plane(const PointCloud::Ptr& cloud) {
  pcl::SACSegmentation<pcl::PointXYZ> segmentation;
  segmentation.setOptimizeCoefficients(true);
  segmentation.setModelType(pcl::SACMODEL_PLANE);
  segmentation.setMethodType(pcl::SAC_RANSAC);
  segmentation.setDistanceThreshold(0.010);
  segmentation.setInputCloud(cloud);
  auto inliers = std::make_shared<pcl::PointIndices>();
  pcl::ModelCoefficients plane;
  segmentation.segment(*inliers, plane);
  pcl::ExtractIndices<pcl::PointXYZ> extract;
  extract.setInputCloud(cloud);
  extract.setIndices(inliers);
  extract.setNegative(true);
  auto rest = std::make_shared<PointCloud>();
  extract.filter(*rest);
  return rest;
}

PointCloud::Ptr thinned(const PointCloud::Ptr& cloud) {
  pcl::VoxelGrid<pcl::PointXYZ> grid;
  grid.setInputCloud(cloud);
  grid.setLeafSize(0.003f, 0.003f, 0.003f);
  auto result = std::make_shared<PointCloud>();
  grid.filter(*result);
  return result;
}

std::vector<pcl::PointIndices> clusters_of(const PointCloud::Ptr& cloud) {
  auto tree = std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>();
  tree->setInputCloud(cloud);
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setClusterTolerance(0.040);
  extraction.setMinClusterSize(100);
  extraction.setSearchMethod(tree);
  extraction.setInputCloud(cloud);
  std::vector<pcl::PointIndices> clusters;
  extraction.extract(clusters);
  return clusters;
}

}  // namespace

std::vector<double> pcl_pipeline(const Cloud& cloud, const std::vector<CupTemplate>& templates) {
  const PointCloud::Ptr objects = thinned(without_largest_plane(pcl_cloud_of(finite_points(cloud))));
  std::vector<double> scores;
  for (const pcl::PointIndices& cluster : clusters_of(objects)) {
    auto segment = std::make_shared<PointCloud>(*objects, cluster.indices);
    Eigen::Vector4f middle;
    pcl::compute3DCentroid(*segment, middle);
    pcl::transformPointCloud(*segment, *segment, Eigen::Vector3f(-middle.head<3>()), Eigen::Quaternionf::Identity());
    double best = std::numeric_limits<double>::infinity();
    for (const CupTemplate& cup : templates) {
      pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> icp;
      icp.setInputSource(segment);
      icp.setInputTarget(pcl_cloud_of(cup.points));
      icp.setMaximumIterations(30);
      PointCloud aligned;
      icp.align(aligned);
      best = std::min(best, icp.getFitnessScore());
    }
    scores.push_back(best);
  }
  return scores;
}

}  // namespace fathom
