#include "detector/pcl_points.h"

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

namespace fathom {

std::shared_ptr<PclCloud> pcl_cloud(const Points& points) {
  auto cloud = std::make_shared<PclCloud>();
  cloud->reserve(points.size());
  for (const Eigen::Vector3f& point : points) cloud->push_back({point.x(), point.y(), point.z()});
  return cloud;
}

Points points_from(const PclCloud& cloud) {
  Points points;
  points.reserve(cloud.size());
  for (const pcl::PointXYZ& point : cloud) points.emplace_back(point.x, point.y, point.z);
  return points;
}

}  // namespace fathom
