// What tells whether two clouds are the same, or of a sensor without noise.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "diagnosis/measurement/frame_estimates.h"

namespace fathom {

struct CloudPrint {
  std::uint64_t whole = 0;                ///< equal for equal clouds, in whatever file; 0 without points
  std::array<std::uint64_t, 12> parts{};  ///< of the image, depths alone; 0 with less than a hundred points
};

CloudPrint print_of(std::span<const SensedPoint> points, double focal_px);

}  // namespace fathom
