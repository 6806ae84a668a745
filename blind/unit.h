// The unit's own bias: what its disparities are off by over the image that it remembers, the same in every frame.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace fathom::blind {

inline constexpr int kUnitColumns = 9, kUnitRows = 7;
/// All but those that are nearly planes: a plane of bias cannot be told from how the sensor stands, which has errors of
/// its own (laboratory.h).
inline constexpr int kUnitWaves = kUnitColumns * kUnitRows - 3;
using UnitBias = std::array<double, kUnitWaves>;  ///< [px] amplitudes

/// Standard deviation of each amplitude [px], of units of the usual size: 0.1 px in the mean over the image, over 70
/// px. Desks of one Kinect v1 are off their planes by 0.097 px, those of another by 0.085 px over 70 px.
const UnitBias& unit_sigmas();

/// One unit, half to one and a half times as large, over 60 to 110 px.
UnitBias draw_unit(std::uint64_t seed);

/// Bias of disparity at a place of the memorised image [px].
double unit_px(const UnitBias& unit, const Eigen::Vector2d& reference_pixel);

/// What is left of it, as a share, where a laboratory's clouds show the desk. Borrowed from a Kinect: so much is left
/// on a desk in a pose of which others were seen (docs/calibrate.md).
inline constexpr double kLeftOfUnit = 0.35;

}  // namespace fathom::blind
