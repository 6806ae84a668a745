// The device's table of depths: what it makes of a shift, whatever the unit that measured it is like.
#pragma once

#include <cmath>

namespace fathom::blind {

inline constexpr double kTableFocalPx = 570.342;
inline constexpr double kTableBaseline = 0.075;
inline constexpr double kReferenceMm = 1200.0;
inline constexpr double kZppsMm = 0.1052;  ///< ten times the pixel's size on the reference plane [cm]: Xtion PRO LIVE
/// f b of the table [px mm]: one step is an eighth of a pixel, p/36000 in 1/z.
inline constexpr double kDisparityMm = 36000.0 / kZppsMm / 8.0;

/// Disparity [px] of a depth [m], and back, without steps.
inline double disparity_of(double depth) { return kDisparityMm / (1000.0 * depth); }
inline double depth_of(double disparity_px) { return kDisparityMm / (1000.0 * disparity_px); }

/// Depth [m] of step n: z = floor(1 / (1/1200 − (n + 1/2) p / 36000)) mm, exact on recorded frames of the device.
inline double depth_of_step(double n) {
  return 1e-3 * std::floor(1.0 / (1.0 / kReferenceMm - (n + 0.5) * kZppsMm / 36000.0));
}

/// Depth [m] that the device gives for a disparity that its matcher resolves in `steps_per_px`; coarser steps are
/// whole multiples of the table's.
inline double device_depth(double disparity_px, double steps_per_px = 8.0) {
  const double shift = kDisparityMm / kReferenceMm - disparity_px;
  const double step = std::floor(steps_per_px * shift);
  return depth_of_step(std::floor((step + 0.5) * 8.0 / steps_per_px));
}

}  // namespace fathom::blind
