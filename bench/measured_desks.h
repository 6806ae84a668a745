// Desks with things on them that a Kinect v1 measured (mOSD); they are no part of the project.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "detector/plane.h"

namespace fathom {

/// Depth as an application gets it that asks for registration to the colour camera, whose focal length is 525 px.
inline constexpr double kColourFocalPx = 525.0;

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

/// What the colour camera, 25 mm to the right, has in each pixel of a depth image of focal length `focal_px`: the
/// nearest. Depths stay as they are, as the device leaves them.
Image<float> in_colour_view(const Image<float>& depth, double focal_px);

}  // namespace fathom
