#include "detector/cloud.h"

#include <algorithm>
#include <iterator>
#include <limits>

namespace fathom {

Points finite_points(const Cloud& cloud) {
  Points points;
  points.reserve(cloud.points.size());
  std::copy_if(cloud.points.begin(), cloud.points.end(), std::back_inserter(points),
               [](const Eigen::Vector3f& point) { return point.allFinite(); });
  return points;
}

void take_as_measured(Cloud& cloud) {
  for (Eigen::Vector3f& point : cloud.points)
    if (!point.allFinite() || point.isZero(0.0f)) point.setConstant(std::numeric_limits<float>::quiet_NaN());
  const auto is_before = [](const Eigen::Vector3f& point) { return point.z() >= 0.0f; };
  if (std::any_of(cloud.points.begin(), cloud.points.end(), is_before)) return;
  for (Eigen::Vector3f& point : cloud.points) point.tail<2>() *= -1.0f;
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
