// A measured point cloud, organised as the camera's pixels where the file keeps them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/cloud_file.h"

namespace fathom {

using Points = std::vector<Eigen::Vector3f>;

struct Cloud {
  Points points;  ///< [m] camera frame: x right, y down, z forward; row-major; NaN where nothing was measured
  std::vector<float> intensity;  ///< as many as points, or empty when the file has none
  int width = 0;
  int height = 0;  ///< 1: not organised
};

/// A simulated cloud as a detector takes it.
Cloud cloud_from_image(const Image<CloudPoint>& image);

/// The measured points only, in the cloud's order.
Points finite_points(const Cloud& cloud);

}  // namespace fathom
