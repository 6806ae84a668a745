// The directions in which the pixels of an organised cloud look, from the cloud itself: also those that measured
// nothing.
#pragma once

#include <optional>

#include "detector/cloud.h"

namespace fathom {

struct Pinhole {
  double focal_x_px, focal_y_px;
  double center_x_px, center_y_px;  ///< of the first pixel's centre (0.5, 0.5)

  /// Direction of a pixel's line of sight, camera frame, z = 1.
  Eigen::Vector3d sight(int column, int row) const {
    return {(column + 0.5 - center_x_px) / focal_x_px, (row + 0.5 - center_y_px) / focal_y_px, 1.0};
  }
};

/// Straight lines through x/z over the columns and y/z over the rows. Nothing when the cloud is not organised, has too
/// few points, or its points lie farther than half a pixel (root mean square) from the lines.
std::optional<Pinhole> pinhole_of(const Cloud& cloud);

}  // namespace fathom
