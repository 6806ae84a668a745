// How far off a mean height is, read from the desk, which is level: means over patches of it scatter as a mean over as
// many points inside a cup does, whatever the sensor is and however alike its neighbours err.
#pragma once

#include <array>
#include <optional>

#include "detector/cloud.h"

namespace fathom {

class MeanError {
 public:
  /// `points` [m, desk frame] are the whole scene's. Where they show too little bare desk, what recorded desks show
  /// (detector/depth_noise.h) is taken instead.
  MeanError(const Points& points, double camera_height_m);

  /// Standard deviation [m] of the mean height of `points` neighbours inside a cup, about a place in the desk frame.
  double of_height(int points, const Eigen::Vector3d& place) const;

 private:
  static constexpr int kSizes = 8;  ///< of patches: 32 points and more, each twice as many as the one before
  static int size_of(int points);

  double camera_height_m_;
  std::array<std::optional<double>, kSizes> depth_error_m_;  ///< at a range of 1 m; it grows with the range's square
};

}  // namespace fathom
