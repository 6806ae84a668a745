#include "detector/cloud.h"

#include <algorithm>
#include <iterator>

namespace fathom {

Points finite_points(const Cloud& cloud) {
  Points points;
  points.reserve(cloud.points.size());
  std::copy_if(cloud.points.begin(), cloud.points.end(), std::back_inserter(points),
               [](const Eigen::Vector3f& point) { return point.allFinite(); });
  return points;
}

Cloud cloud_from_image(const Image<CloudPoint>& image) {
  Cloud cloud{.points = {}, .intensity = {}, .width = image.width(), .height = image.height()};
  cloud.points.reserve(image.size());
  cloud.intensity.reserve(image.size());
  for (const CloudPoint& point : image.pixels()) {
    cloud.points.emplace_back(point.x, point.y, point.z);
    cloud.intensity.push_back(point.intensity);
  }
  return cloud;
}

}  // namespace fathom
