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

/// What others' clouds need first. Points with a coordinate that is not finite, and points at (0, 0, 0) (how some
/// writers say "nothing measured"), become NaN. A cloud that lies wholly at negative z is in the other common camera
/// frame (y up, z backward, as in OpenGL) and is turned.
void take_as_measured(Cloud& cloud);

/// The measured points only, in the cloud's order.
Points finite_points(const Cloud& cloud);

}  // namespace fathom
