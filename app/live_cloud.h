// Clouds from any device that OpenNI2 knows, real or virtual.
#pragma once

#include <memory>
#include <string>

#include "core/cloud_file.h"

namespace fathom {

class LiveCamera {
 public:
  /// An empty URI stands for the first device. Throws Error when there is none, or it gives no depth.
  explicit LiveCamera(const std::string& uri);
  ~LiveCamera();

  const std::string& uri() const { return uri_; }
  /// The next frame as an organised cloud in the camera frame [m], by the device's field of view; NaN where nothing was
  /// measured. Intensities [DN] where the device gives infrared beside depth, else 0. Throws Error when none comes
  /// within 10 s.
  Image<CloudPoint> next_cloud();

 private:
  void start_infrared();

  struct Session;
  std::string uri_;
  std::unique_ptr<Session> session_;
};

}  // namespace fathom
