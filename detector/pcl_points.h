// Points as PCL wants them. Names PCL's types without its headers, which stay in .cpp files.
#pragma once

#include <memory>

#include "detector/cloud.h"

namespace pcl {
struct PointXYZ;
template <class Point>
class PointCloud;
}  // namespace pcl

namespace fathom {

using PclCloud = pcl::PointCloud<pcl::PointXYZ>;

std::shared_ptr<PclCloud> pcl_cloud(const Points& points);
Points points_from(const PclCloud& cloud);

}  // namespace fathom
