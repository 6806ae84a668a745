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

}  // namespace fathom
