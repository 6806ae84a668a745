// The noise of measured depth on a desk: the same estimators for real clouds and for simulated ones.
#pragma once

#include <array>
#include <vector>

#include "core/image.h"
#include "sim/scene/rig.h"

namespace fathom {

/// Depth as the device's codes, one step of 1/8 px of disparity each, rising with distance; NaN = invalid.
Image<float> depth_codes(const SensorModel& sensor, const Image<float>& depth);

inline constexpr int kNoiseWindow = 31;  ///< pixels along each side
inline constexpr std::array kLagsX{1, 2, 4, 8};
inline constexpr std::array kLagsY{1, 2, 4};

/// One window of desk, its own plane of codes removed.
struct DeskWindow {
  int left, top;                                   ///< its first pixel
  double depth;                                    ///< [m] in the middle
  double sigma_steps;                              ///< standard deviation about the plane
  double height;                                   ///< [m] of its middle above the desk's plane, towards the sensor
  std::array<double, kLagsX.size()> covariance_x;  ///< [steps²] at each lag
  std::array<double, kLagsY.size()> covariance_y;
};

/// All windows, side by side, in which every pixel has a depth that is desk: within `most_off` [m] of the plane
/// normal · p = offset (camera frame, normal towards the sensor).
std::vector<DeskWindow> desk_windows(const SensorModel& sensor, const Image<float>& depth, double focal_px,
                                     const Eigen::Vector3d& normal, double offset, double most_off);

/// What the windows about a distance have in common.
struct DeskNoise {
  int windows = 0;
  double sigma_steps = 0.0;  ///< root mean square
  double sigma = 0.0;        ///< [m]
  double height = 0.0;       ///< [m] mean
  std::array<double, kLagsX.size()> correlation_x{};
  std::array<double, kLagsY.size()> correlation_y{};
};
DeskNoise desk_noise(const SensorModel& sensor, const std::vector<DeskWindow>& windows, double from, double to);

}  // namespace fathom
