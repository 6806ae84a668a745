// Desks with things on them that a Kinect v1 measured (mOSD); they are no part of the project.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "detector/plane.h"
#include "sim/sensor/depth.h"

namespace fathom {

struct DeskImage {
  std::string name;
  Image<float> depth;  ///< [m] 0 = invalid
  Image<int> label;    ///< of the thing seen; empty: not known
  Plane desk;          ///< least squares, camera frame
};

/// The clouds in FATHOM_REAL_DATA (or beside the project); none where they are absent.
std::vector<DeskImage> measured_desks();

/// A depth image with the desk that is found in it, pitched by about 35° and 0.6 m below.
std::optional<DeskImage> with_desk(std::string name, Image<float> depth);

/// The camera's point of a pixel of the colour camera's image.
Eigen::Vector3d point_in_colour(const Image<float>& depth, int x, int y);

}  // namespace fathom
