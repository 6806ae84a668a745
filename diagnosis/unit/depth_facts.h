// What a device's depths say of its steps: on which values they lie.
#pragma once

#include <span>

#include "detector/cloud.h"

namespace fathom {

struct DepthFacts {
  double cut_mm = 0.0;     ///< depths are whole multiples of it: 1, 0.1 or 0 (they are not)
  double step_px = 0.0;    ///< of disparity; 0: none are seen
  double phase = 0.0;      ///< where depths lie between whole codes, in steps of 1/8 px
  int codes_per_step = 1;  ///< codes of 1/8 px that come together
  double on_law = 0.0;     ///< share of the depths that lie on the law with these numbers
  double focal_px = 0.0;   ///< of the law: of those asked for the one that fits best
};

/// The depth law z = floor(1 / (1 / 1200 mm − (n + phase) / 8 f b)) (spec of PrimeSense devices; sim/sensor/depth.h),
/// for each of these focal lengths. A law counts where 98 of 100 depths lie on it and fewer than 90 would by chance.
DepthFacts depth_facts(std::span<const Points> clouds, std::span<const double> focal_px, double baseline_m);

}  // namespace fathom
