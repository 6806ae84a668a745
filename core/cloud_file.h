// Point clouds for writing: the organised cloud of a capture as binary PCD 0.7.
#pragma once

#include <filesystem>

#include "core/image.h"

namespace fathom {

struct CloudPoint {
  float x, y, z;    ///< [m] camera frame: x right, y down, z forward; NaN = invalid
  float intensity;  ///< infrared [DN]
};

/// Organised, fields x y z intensity, as PCL reads it. Written whole or not at all.
void write_pcd(const std::filesystem::path& path, const Image<CloudPoint>& cloud);

/// The same without that promise, and so without waiting for the disk: for folders that appear whole.
void put_pcd(const std::filesystem::path& path, const Image<CloudPoint>& cloud);

}  // namespace fathom
